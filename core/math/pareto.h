#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

// A way to draw, by what it costs and how far it is from the truth: less is better in both.
struct CostAndError {
  double cost = 0.0, error = 0.0;
};

// Indices of the points that none beats, by rising cost: no other is as good in both and better in one. Of
// equal points the first. Points with a NaN are on no front.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace pinocchio
