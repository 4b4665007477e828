#pragma once

#include <glm/glm.hpp>

#include "pinocchio/view.h"

namespace pinocchio {

// Where sample k of a pixel is, off the pixel's centre, pixels: sample 0 is the centre, the others are spread
// as the filter has it, evenly however many there are. All samples count alike.
[[nodiscard]] glm::vec2 jitter_of(int k, PixelFilter filter = PixelFilter::box);

// Where on the lens sample k of a picture is, on a disc of radius 1: sample 0 is its centre. All pixels of a
// frame have the same, so that a rasteriser can draw it.
[[nodiscard]] glm::vec2 lens_point_of(int k);

// The view's sample k, of its pixels and of all that they sample.
[[nodiscard]] View at_sample(View view, int k, PixelFilter filter = PixelFilter::box);

}  // namespace pinocchio
