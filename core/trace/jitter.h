#pragma once

#include <glm/glm.hpp>

#include "pinocchio/view.h"

namespace pinocchio {

// Where sample k of a pixel is, off the pixel's centre, pixels in [-0.5, 0.5): sample 0 is the centre, the
// others are spread evenly over the pixel however many there are.
[[nodiscard]] glm::vec2 jitter_of(int k);

// The view's sample k, of its pixels and of all that they sample.
[[nodiscard]] View at_sample(View view, int k);

}  // namespace pinocchio
