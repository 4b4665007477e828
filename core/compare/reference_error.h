#pragma once

#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "pinocchio/image.h"

namespace pinocchio {

enum class ErrorMap {
  flip,        // how different it seems to a person
  difference,  // largest of R, G and B's |a - b|, linear
};

// How far a picture is from the precise one.
struct ReferenceError {
  Image<glm::u8vec3> heat;  // sRGB; black: equal, pale yellow: 1 or more
  double rmse = 0.0;        // linear light, over R, G and B
  double mean_flip = 0.0;   // as a screen shows the two: clamped to [0, 1]
};

// picture, reference: the same size, RGBA, linear; what is not finite counts as black. Takes about a
// second for a million pixels on one core: not for every frame.
[[nodiscard]] ReferenceError error_against(const Image<glm::vec4>& picture, const Image<glm::vec4>& reference,
                                           ErrorMap map, Workers& workers);

}  // namespace pinocchio
