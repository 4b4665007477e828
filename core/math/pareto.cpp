#include "core/math/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pinocchio {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isnan(points[i].cost) && !std::isnan(points[i].error)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(points[a].cost, points[a].error) < std::tie(points[b].cost, points[b].error);
  });
  std::vector<std::size_t> front;
  double least_error = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(points[i].error < least_error)) continue;  // some cheaper point is as good
    least_error = points[i].error;
    front.push_back(i);
  }
  return front;
}

}  // namespace pinocchio
