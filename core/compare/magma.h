#pragma once

#include <glm/glm.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// Errors in [0, 1] as colours: black, violet, orange, pale yellow, brighter for larger errors (matplotlib's
// magma, within two steps of 255). Values out of range are clamped.
[[nodiscard]] Image<glm::u8vec3> magma(const Image<float>& errors);

}  // namespace pinocchio
