#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace pinocchio {

// The largest of the components' magnitudes.
template <class T>
[[nodiscard]] T largest_component(const glm::vec<3, T>& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace pinocchio
