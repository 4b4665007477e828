#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace pinocchio {

[[nodiscard]] inline bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace pinocchio
