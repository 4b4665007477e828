#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

namespace pinocchio {

// values: at least one, none NaN. With an even number, the mean of the middle two.
template <class Real>
[[nodiscard]] Real median(std::vector<Real> values) {
  assert(!values.empty());
  const auto upper = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) return *upper;
  return (*std::max_element(values.begin(), upper) + *upper) / Real(2);
}

}  // namespace pinocchio
