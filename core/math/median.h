#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace pinocchio {

// values: at least one, none NaN. Of an even number the mean of the two in the middle.
template <class Real>
[[nodiscard]] Real median(std::vector<Real> values) {
  assert(!values.empty());
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) return *upper;
  return (*std::max_element(values.begin(), upper) + *upper) / Real(2);
}

}  // namespace pinocchio
