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

// Which triangles have a clear way to one light (clear_way.h), found as rays ask for it, and which parts of
// large triangles that have none as a whole. Shadow rays from these need not be traced. May be called from
// many threads, in any order: the answer to a call depends on what was asked before, but a shadow ray's
// result is the same either way.
class ClearWays {
 public:
  ClearWays(std::shared_ptr<const SceneTrees> trees, const LightPlace& light);

  enum class Way { unknown, clear, by_part };
  // The way from a whole triangle, as far as it is known. Counts `rays` more shadow rays there; once they are
  // kEnough, it is searched: by then, tracing them has taken about as long as a search.
  [[nodiscard, gnu::always_inline]] Way way_of(std::uint32_t triangle, unsigned rays) {
    const std::uint8_t known = known_[triangle].load(std::memory_order_acquire);
    if (known == kClear) return Way::clear;
    if (known == kByPart) return Way::by_part;
    if (known == kHidden || (known == kSearched && rays < kManyAtOnce)) return Way::unknown;
    return count(triangle, known, rays);
  }
  // True if the way from a part is known to be clear. It counts and searches as way_of() does, which must
  // have answered by_part for the triangle.
  [[nodiscard]] bool is_part_clear(std::uint32_t triangle, std::uint32_t part, unsigned rays);

  // What way_of() and is_part_clear() would answer without a search. No rays are counted.
  [[nodiscard]] Way known_way(std::uint32_t triangle) const;
  [[nodiscard]] bool is_part_known_clear(std::uint32_t triangle, std::uint32_t part) const;

  [[nodiscard]] const LightPlace& light() const { return light_; }

 private:
  // The state of a triangle or part: the number of rays that have asked, while that is below kEnough; then
  // the answer. kSearched: of a triangle that is not clear as a whole, until its rays are many.
  static constexpr std::uint8_t kEnough = 64, kSearched = 252, kByPart = 253, kHidden = 254, kClear = 255;
  using States = std::vector<std::atomic<std::uint8_t>>;
  // A triangle has parts once so many more rays have asked. They are counted where a packet has several of
  // them: counting single rays would cost meshes of small triangles more than large ones gain.
  static constexpr std::uint32_t kEnoughForParts = 4096, kManyAtOnce = 4;
  // Triangles that have parts.
  static constexpr std::size_t kMostByPart = 256;

  Way count(std::uint32_t triangle, std::uint8_t known, unsigned rays);
  Way count_for_parts(std::uint32_t triangle, unsigned rays);

  std::shared_ptr<const SceneTrees> trees_;
  LightPlace light_;
  States known_;  // by triangle
  // By triangle. In state kSearched: the rays that have asked since. In state kByPart: kIndex + n, where its
  // parts' states begin at parts_[n * kParts].
  static constexpr std::uint16_t kIndex = 0x8000;
  std::vector<std::atomic<std::uint16_t>> more_;
  std::atomic<std::uint32_t> by_part_ = 0;  // triangles that have asked for parts
  States parts_;
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
