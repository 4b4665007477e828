#include "core/bsp/clear/clear_ways.h"

#include <algorithm>
#include <new>
#include <utility>

#include "core/base/prefetch.h"

namespace pinocchio {

ClearWays::ClearWays(std::shared_ptr<const SceneTrees> trees, const LightPlace& light)
    : trees_(std::move(trees)), light_(light), known_(trees_->corners.size()) {}

bool ClearWays::count(std::uint32_t triangle, unsigned rays) {
  std::atomic<std::uint8_t>& known = known_[triangle];
  if (rays < kEnough) {
    known.store(static_cast<std::uint8_t>(rays), std::memory_order_relaxed);
    return false;
  }
  const bool clear = has_clear_way(*trees_, triangle, light_);
  known.store(clear ? kClear : kHidden, std::memory_order_relaxed);
  return clear;
}

bool ClearWaysToLights::serves(const SceneTrees& trees) {
  return trees.top.empty() && trees.still->test == TriangleTest::filtered &&
         !trees.still->triangles.empty() && trees.corners.size() <= kLargeMesh;
}

std::vector<std::shared_ptr<ClearWays>> ClearWaysToLights::to(std::span<const LightPlace> lights) {
  std::vector<std::shared_ptr<ClearWays>> ways(lights.size());
  const std::scoped_lock lock(mutex_);
  try {
    for (std::size_t i = 0; i < std::min(lights.size(), kMost); ++i) {
      const auto known =
          std::ranges::find_if(last_, [&](const auto& way) { return way && way->light() == lights[i]; });
      ways[i] = known != last_.end() ? *known : std::make_shared<ClearWays>(trees_, lights[i]);
    }
    last_ = ways;
  } catch (const std::bad_alloc&) {  // tracing needs no more memory
  }
  return ways;
}

}  // namespace pinocchio
