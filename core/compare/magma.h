#pragma once

#include <glm/glm.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// Errors in [0, 1] as colours a person reads at a glance: black, violet, orange, pale yellow, as bright as
// they are large (matplotlib's magma, to a step or two of 255). Out of range is clamped.
[[nodiscard]] Image<glm::u8vec3> magma(const Image<float>& errors);

}  // namespace pinocchio
