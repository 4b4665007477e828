#pragma once

#include <glm/glm.hpp>

#include "pinocchio/view.h"

namespace pinocchio {

// Offset of a pixel's sample k from the pixel's centre, in pixels, spread by the filter; all samples have the
// same weight. Sample 0 is the centre, which is also the mean of 4, 8, 10, 12 and so on samples: with a
// mean beside the centre, all outlines would shift.
[[nodiscard]] glm::vec2 jitter_of(int k, PixelFilter filter = PixelFilter::box);

// The lens point of a picture's sample k, on a disc of radius 1: sample 0 is its centre, which is also the
// mean of any even number of samples from 4 on. All pixels of a frame share it, so that a rasteriser can draw
// it.
[[nodiscard]] glm::vec2 lens_point_of(int k);

// The view for sample k.
[[nodiscard]] View at_sample(View view, int k, PixelFilter filter = PixelFilter::box);

}  // namespace pinocchio
