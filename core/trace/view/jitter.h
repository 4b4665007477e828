#pragma once

#include <glm/glm.hpp>

#include "pinocchio/view.h"

namespace pinocchio {

// Offset of a pixel's sample k from the pixel's centre, in pixels: sample 0 is the centre, the others are
// spread by the filter, evenly for any number of them. All samples have the same weight.
[[nodiscard]] glm::vec2 jitter_of(int k, PixelFilter filter = PixelFilter::box);

// The same, moved so that the centre is the mean of samples 1 to 3, 4 to 7, 8 to 15 and so on. The mean of
// the others is off it by up to a seventh of a pixel where they are few, and so are outlines. With so few
// samples a filtered picture shows that.
[[nodiscard]] glm::vec2 balanced_jitter_of(int k, PixelFilter filter = PixelFilter::box);

// The lens point of a picture's sample k, on a disc of radius 1: sample 0 is its centre. All pixels of a
// frame share it, so that a rasteriser can draw it.
[[nodiscard]] glm::vec2 lens_point_of(int k);

// The view for sample k.
[[nodiscard]] View at_sample(View view, int k, PixelFilter filter = PixelFilter::box, bool balanced = false);

}  // namespace pinocchio
