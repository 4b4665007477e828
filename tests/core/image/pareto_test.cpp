#include "core/math/pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pinocchio {
namespace {

bool beats(const CostAndError& a, const CostAndError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

TEST(Pareto, HoldsExactlyWhatNoPointBeats) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> grid(0, 30);  // coarse, so that there are ties
  for (int round = 0; round < 200; ++round) {
    std::vector<CostAndError> points(40);
    for (CostAndError& p : points) p = {static_cast<double>(grid(random)), static_cast<double>(grid(random))};
    const std::vector<std::size_t> front = pareto_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool beaten = std::any_of(points.begin(), points.end(),
                                      [&](const CostAndError& other) { return beats(other, points[i]); });
      const bool has_earlier_twin = std::any_of(
          points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i), [&](const CostAndError& other) {
            return !beats(other, points[i]) && !beats(points[i], other) && other.cost == points[i].cost;
          });
      EXPECT_EQ(std::find(front.begin(), front.end(), i) != front.end(), !beaten && !has_earlier_twin);
    }
    EXPECT_TRUE(std::is_sorted(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
      return points[a].cost < points[b].cost;
    }));
  }
}

TEST(Pareto, NothingWithNaNAndNothingOfNothing) {
  EXPECT_TRUE(pareto_front({}).empty());
  const std::vector<CostAndError> points{{1.0, std::nan("")}, {std::nan(""), 0.0}, {2.0, 0.0}, {1.0, 0.0}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{3}));
}

}  // namespace
}  // namespace pinocchio
