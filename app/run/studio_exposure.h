#pragma once

#include "app/run/drawing.h"

namespace pinocchio::app {

// The exposure, in quarters of a stop, that shows the frame's surfaces neither dark nor burnt out: their
// median is a middle grey unless that clips more than 5 % of them. Measured on a picture of a few thousand
// pixels.
[[nodiscard]] float studio_exposure(Drawing& drawing, const CameraFrame& frame);

}  // namespace pinocchio::app
