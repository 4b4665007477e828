#pragma once

#include "hybrid/flight.h"
#include "hybrid/picture.h"

namespace pinocchio {

// Draws the whole frame on the CPU; needs no OpenGL. In the record, raster is the primary rays and
// composite the shading; a precise
// plan is drawn whole in composite, and its rays are not counted.
[[nodiscard]] FrameRecord raytrace(const FrameRequest& request, Workers& workers, Picture& picture);

}  // namespace pinocchio
