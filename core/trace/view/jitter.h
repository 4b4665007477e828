#pragma once

#include <glm/glm.hpp>

#include "pinocchio/view.h"

namespace pinocchio {

// Offset of a pixel's sample k from the pixel's centre, in pixels: sample 0 is the centre, the others are
// spread by the filter, evenly for any number of them. All samples have the same weight.
[[nodiscard]] glm::vec2 jitter_of(int k, PixelFilter filter = PixelFilter::box);

// The lens point of a picture's sample k, on a disc of radius 1: sample 0 is its centre. All pixels of a
// frame share it, so that a rasteriser can draw it.
[[nodiscard]] glm::vec2 lens_point_of(int k);

// The view for sample k.
[[nodiscard]] View at_sample(View view, int k, PixelFilter filter = PixelFilter::box);

}  // namespace pinocchio
