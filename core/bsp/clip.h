#pragma once

#include <glm/glm.hpp>

#include "core/math/bounds.h"

namespace pinocchio {

// Bounds of the part of triangle abc inside `box`, rounded outwards to float; empty where they are apart.
[[nodiscard]] Bounds clipped_bounds(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                    const Bounds& box);

}  // namespace pinocchio
