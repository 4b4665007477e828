#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace pinocchio {

template <class T>
[[nodiscard]] bool is_finite(const glm::vec<3, T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace pinocchio
