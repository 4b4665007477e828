#include "core/bsp/clear/clear_ways.h"

#include <algorithm>
#include <new>
#include <utility>

#include "core/base/prefetch.h"

namespace pinocchio {

ClearWays::ClearWays(std::shared_ptr<const SceneTrees> trees, const LightPlace& light)
    : trees_(std::move(trees)),
      light_(light),
      known_(trees_->corners.size()),
      more_(trees_->corners.size()),
      parts_(kMostByPart * kParts) {}

ClearWays::Way ClearWays::count(std::uint32_t triangle, std::uint8_t known, unsigned rays) {
  if (known == kSearched) return count_for_parts(triangle, rays);
  const bool enough = known + rays >= kEnough, clear = enough && has_clear_way(*trees_, triangle, light_);
  // Nothing is stored where another thread has counted or searched meanwhile.
  known_[triangle].compare_exchange_strong(known, clear    ? kClear
                                                  : enough ? kSearched
                                                           : static_cast<std::uint8_t>(known + rays));
  return clear ? Way::clear : Way::unknown;
}

ClearWays::Way ClearWays::count_for_parts(std::uint32_t triangle, unsigned rays) {
  std::uint16_t asked = more_[triangle].load();
  if (asked + rays < kEnoughForParts) {
    more_[triangle].compare_exchange_strong(asked, static_cast<std::uint16_t>(asked + rays));
    return Way::unknown;
  }
  std::uint8_t searched = kSearched;  // one thread goes on; the others see a hidden triangle meanwhile
  if (!known_[triangle].compare_exchange_strong(searched, kHidden)) return Way::unknown;
  const std::uint32_t index = by_part_.fetch_add(1);
  if (index >= kMostByPart) return Way::unknown;
  more_[triangle].store(static_cast<std::uint16_t>(kIndex + index));
  known_[triangle].store(kByPart);
  return Way::by_part;
}

bool ClearWays::is_part_clear(std::uint32_t triangle, std::uint32_t part, unsigned rays) {
  const std::size_t index = more_[triangle].load(std::memory_order_relaxed) - kIndex;
  std::atomic<std::uint8_t>& state = parts_[index * kParts + part];
  const std::uint8_t known = state.load(std::memory_order_relaxed);
  if (known >= kEnough) return known == kClear;
  if (known + rays < kEnough) {
    state.store(static_cast<std::uint8_t>(known + rays), std::memory_order_relaxed);
    return false;
  }
  const bool clear = has_clear_way(*trees_, triangle, light_, part_of_inside(part));
  state.store(clear ? kClear : kHidden, std::memory_order_relaxed);
  return clear;
}

ClearWays::Way ClearWays::known_way(std::uint32_t triangle) const {
  const std::uint8_t known = known_[triangle].load(std::memory_order_acquire);
  return known == kClear ? Way::clear : known == kByPart ? Way::by_part : Way::unknown;
}

bool ClearWays::is_part_known_clear(std::uint32_t triangle, std::uint32_t part) const {
  const std::size_t index = more_[triangle].load(std::memory_order_relaxed) - kIndex;
  return parts_[index * kParts + part].load(std::memory_order_relaxed) == kClear;
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
