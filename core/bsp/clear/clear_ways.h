#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/bsp/clear/clear_way.h"
#include "core/bsp/scene_trees.h"

namespace pinocchio {

// Which triangles have a clear way to one light (clear_way.h), found as rays ask for it. Shadow rays from
// these need not be traced. May be called from many threads, in any order: the answer to a call depends on
// what was asked before, but a shadow ray's result is the same either way.
class ClearWays {
 public:
  ClearWays(std::shared_ptr<const SceneTrees> trees, const LightPlace& light);

  // True if the way is known to be clear. rays: how many rays ask now. The call with which a triangle's rays
  // reach kEnough searches: by then, tracing them has taken about as long as a search takes.
  [[nodiscard, gnu::always_inline]] bool is_clear(std::uint32_t triangle, unsigned rays) {
    const std::uint8_t known = known_[triangle].load(std::memory_order_relaxed);
    if (known < kEnough) [[unlikely]]
      return count(triangle, known + rays);
    return known == kClear;
  }

  [[nodiscard]] const LightPlace& light() const { return light_; }

 private:
  // A triangle's state: the number of rays that have asked, while that is below kEnough; then the answer.
  static constexpr std::uint8_t kEnough = 64, kHidden = 254, kClear = 255;

  bool count(std::uint32_t triangle, unsigned rays);

  std::shared_ptr<const SceneTrees> trees_;
  LightPlace light_;
  std::vector<std::atomic<std::uint8_t>> known_;  // by triangle
};

// The clear ways to a scene's lights in one pose. May be called from many threads.
class ClearWaysToLights {
 public:
  // True if `trees` is a single tree of triangles for the filtered test, whose hits are exact. Large meshes
  // are left out: few rays meet one triangle, and the look-ups would wait for memory.
  [[nodiscard]] static bool serves(const SceneTrees& trees);

  explicit ClearWaysToLights(std::shared_ptr<const SceneTrees> trees) : trees_(std::move(trees)) {}

  // By light; null: beyond kMost, or there is no memory. What is known of the lights of the last call is
  // kept.
  [[nodiscard]] std::vector<std::shared_ptr<ClearWays>> to(std::span<const LightPlace> lights);

 private:
  static constexpr std::size_t kMost = 16;

  std::shared_ptr<const SceneTrees> trees_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<ClearWays>> last_;
};

}  // namespace pinocchio
