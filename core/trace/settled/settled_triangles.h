#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/bsp/clear/clear_way.h"
#include "core/trace/settled/known_lights.h"

namespace pinocchio {

// Of a triangle, or of a part of a large one: what hybrid's part finds at each point inside it.
struct SettledPoints {
  // asking: not known yet. by_part: its parts are known, each for itself. never: points differ.
  enum class State : std::uint8_t { asking, settled, by_part, never };
  State state = State::asking;
  bool from_front = false;   // settled: the side that it is seen from
  std::uint16_t lights = 0;  // settled: the bits of those that reach it, in the mask
  // asking: rays that have asked. by_part: the number that part_of() wants. settled: the bits of
  // `rough_within`.
  std::uint32_t more = 0;

  // Such footprints, or shorter ones, find nothing that mirrors, transmits or blends (rough_within.h).
  [[nodiscard]] float rough_within() const { return std::bit_cast<float>(more); }

  // As two words, for lanes: the first has `state`, `from_front` and `lights`, each from its bit on.
  static constexpr int kFrontBit = 8, kLightsBit = 16;
  [[nodiscard]] std::array<std::uint32_t, 2> words() const {
    static_assert(std::endian::native == std::endian::little);
    return std::bit_cast<std::array<std::uint32_t, 2>>(*this);
  }
};

// Which triangles are settled under some lights, found as rays ask for it. Their points need no bounce step
// that draws only the mask and mirrored light. May be called from many threads, in any order: what is known
// depends on what was asked before, but what is found at a point is the same either way.
class SettledTriangles {
 public:
  // What the answers depend on, beside the mesh and its trees.
  struct Under {
    std::vector<MaskLight> lights;
    bool mirrors = false;  // mirrored, refracted and straight rays are followed
    float light_cutoff = 0.0f;

    friend bool operator==(const Under& a, const Under& b);
  };
  SettledTriangles(std::shared_ptr<const Mesh> mesh, Under under);

  [[nodiscard, gnu::always_inline]] SettledPoints of(std::uint32_t triangle) const {
    return std::bit_cast<SettledPoints>(known_[triangle].load(std::memory_order_relaxed));
  }
  // For triangles in state by_part.
  [[nodiscard, gnu::always_inline]] SettledPoints of_part(SettledPoints triangle, std::uint32_t part) const {
    return std::bit_cast<SettledPoints>(parts_[place_of(triangle, part)].load(std::memory_order_relaxed));
  }
  // So many rays, side by side, ask for what is still `asking`. Once enough have, it is searched. Fewer than
  // `many` do not count for long: their triangle is too small for parts.
  void ask(std::uint32_t triangle, unsigned rays, unsigned many, bool from_front);
  void ask_part(std::uint32_t triangle, std::uint32_t part, unsigned rays, bool from_front);

  [[nodiscard]] const Under& under() const { return under_; }

 private:
  using States = std::vector<std::atomic<std::uint64_t>>;
  static_assert(std::has_unique_object_representations_v<SettledPoints> &&
                sizeof(SettledPoints) == sizeof(std::uint64_t));
  // The rays that have asked before the first search, and after the last one.
  static constexpr std::uint32_t kFirstSearch = 64, kEnough = 1024;
  static constexpr std::size_t kMostByPart = 256;

  [[nodiscard]] static std::size_t place_of(SettledPoints triangle, std::uint32_t part) {
    return std::size_t{triangle.more} * kParts + part;
  }
  [[nodiscard]] SettledPoints searched(const PartOfMesh& part, SettledPoints known, unsigned rays,
                                       bool from_front) const;

  std::shared_ptr<const Mesh> mesh_;
  Under under_;
  States known_, parts_;  // by triangle; kParts for each triangle by part
  std::atomic<std::uint32_t> by_part_ = 0;
};

// The triangles of a scene in one pose. May be called from many threads.
class SettledUnderLights {
 public:
  explicit SettledUnderLights(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {}

  // Null until two calls in a row ask for the same: while lights move, searches do not pay. Also null if
  // there is no memory.
  [[nodiscard]] std::shared_ptr<SettledTriangles> of(const SettledTriangles::Under& under);

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::mutex mutex_;
  SettledTriangles::Under last_;  // of the last call
  std::shared_ptr<SettledTriangles> kept_;
};

}  // namespace pinocchio
