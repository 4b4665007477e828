#pragma once

#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "pinocchio/image.h"

namespace pinocchio {

enum class ErrorMap {
  flip,        // the difference that a person sees
  difference,  // the largest |a - b| of R, G and B, linear
};

// The difference between a picture and the precise one.
struct ReferenceError {
  Image<glm::u8vec3> heat;  // sRGB; black: equal, pale yellow: 1 or more
  double rmse = 0.0;        // linear light, over R, G and B
  double mean_flip = 0.0;   // of the pictures on a screen: clamped to [0, 1]
};

// picture, reference: the same size, RGBA, linear. Pixels that are not finite count as black. Takes about a
// second for a million pixels on one core: too slow for every frame.
[[nodiscard]] ReferenceError error_against(const Image<glm::vec4>& picture, const Image<glm::vec4>& reference,
                                           ErrorMap map, Workers& workers);

}  // namespace pinocchio
