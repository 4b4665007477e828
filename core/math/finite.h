#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace pinocchio {

template <int N>
[[nodiscard]] bool is_finite(const glm::vec<N, float>& v) {
  bool finite = true;
  for (int i = 0; i < N; ++i) finite &= std::isfinite(v[i]);
  return finite;
}

}  // namespace pinocchio
