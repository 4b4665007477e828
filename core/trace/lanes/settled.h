// Part of walk/kernel.h's files: pixels that need no step, as all is known of the points that they see.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/trace/lanes/in_triangle.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/settled/settled_triangles.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The lanes of the packet from numbers[i] on whose number is not the one before, and the first lane.
inline unsigned begins_of_runs(const std::uint32_t* numbers, std::size_t i) {
  if (i > 0) return (~(Int::load(numbers + i) == Int::load_unaligned(numbers + i - 1))).bits() | 1u;
  unsigned begins = 1;
  for (std::size_t k = 1; k < kWidth; ++k) begins |= numbers[k] != numbers[k - 1] ? 1u << k : 0u;
  return begins;
}

// The settled points that a tile sees: list(), meet() and write() in this order.
class SettledInTile {
 public:
  SettledInTile(SettledTriangles& settled, const SceneArrays& scene) : settled_(settled), scene_(scene) {}

  // Lists the triangles that the pixels see, as far as they may be settled.
  void list(const std::uint32_t* ids) {
    for (std::size_t i = 0; i < kPixels; i += kWidth) {
      if ((~(Int::load(ids + i) == Int(kNoTriangle))).bits() == 0) continue;
      unsigned begins = begins_of_runs(ids, i);
      while (begins != 0) {
        const int begin = __builtin_ctz(begins);
        begins &= begins - 1;
        const int end = begins == 0 ? kWidth : __builtin_ctz(begins);
        const std::uint32_t id = ids[i + as_size(begin)];
        if (id == kNoTriangle) continue;
        const std::uint16_t number = number_of(id);
        if (number != kNever)
          run_[run_count_++] = {static_cast<std::uint16_t>(i), number, (1u << end) - (1u << begin)};
      }
    }
  }

  // Finds where the tile's rays meet them.
  void meet(const TileRays& rays) {
    for (std::size_t first = 0; first < count_; first += kWidth) {
      const std::size_t lanes = std::min(std::size_t{kWidth}, count_ - first);
      TrianglesInTile& group = group_[first / kWidth];
      for (std::size_t lane = lanes; lane < kWidth; ++lane)
        group.set_corners(lane, glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f));
      group.meet(rays);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const SettledPoints known = known_of(first + lane);
        float& least = group.least_total[lane];
        if (known.state == SettledPoints::State::by_part)
          least = std::max(least, group.least_for_parts[lane]);
        if (known.state != SettledPoints::State::settled) continue;
        if (known.from_front != (group.from_front >> lane & 1u)) least = kInfinity;
        if (known.rough_within() < kInfinity)
          least = std::max(least, std::sqrt(group.footprint[lane] / known.rough_within()));
      }
    }
  }

  // At the pixels of which all is known: writes the bits of the lights to `mask`, and kNoTriangle to `ids`.
  void write(std::uint32_t* ids, std::uint8_t* mask) {
    alignas(64) std::uint32_t bits[kWidth];
    std::iota(bits, bits + kWidth, 0u);
    const Float lane = to_float(Int::load(bits));
    for (std::size_t r = 0; r < run_count_;) {
      const std::size_t i = run_[r].first;
      const Float x = lane + Float(as_float(i % kSide)), y = Float(as_float(i / kSide));
      Mask found = Mask::from_bits(0);
      Int lights(0u);
      for (; r < run_count_ && run_[r].first == i; ++r)
        found = found | find(run_[r].number, Mask::from_bits(run_[r].lanes), x, y, lights);
      if (found.bits() == 0) continue;
      select(found, Int(kNoTriangle), Int::load(ids + i)).store(ids + i);
      lights.store(bits);
      std::uint8_t* const to = mask + i;
      for (std::size_t k = 0; k < kWidth; ++k) to[k] = static_cast<std::uint8_t>(bits[k]);
    }
  }

 private:
  static constexpr std::size_t kSide = std::size_t{1} << kTileBits, kPixels = kSide * kSide;
  static constexpr std::uint16_t kNever = 0xffff;
  // Triangles of which a row of a packet sees as many pixels are large enough for parts.
  static constexpr unsigned kManyInARow = 8;

  static unsigned count(Mask lanes) { return as_uint32(__builtin_popcount(lanes.bits())); }

  // The number of a triangle here; kNever: it is not settled.
  std::uint16_t number_of(std::uint32_t id) {
    Last& last = last_[id % last_.size()];
    if (last.id != id) last = {id, add(id)};
    return last.number;
  }

  [[nodiscard]] SettledPoints known_of(std::size_t number) const {
    return std::bit_cast<SettledPoints>(known_[number]);
  }

  std::uint16_t add(std::uint32_t id) {
    const SettledPoints known = settled_.of(id);
    if (known.state == SettledPoints::State::never) return kNever;
    id_[count_] = id;
    known_[count_] = std::bit_cast<std::uint64_t>(known);
    const glm::uvec3& corners = scene_.triangles[id];
    group_[count_ / kWidth].set_corners(count_ % kWidth, scene_.positions[corners.x],
                                        scene_.positions[corners.y], scene_.positions[corners.z]);
    return static_cast<std::uint16_t>(count_++);
  }

  // The lanes of which all is known. `same` see the triangle of that number, in the pixels (x, y). In the
  // lanes that are returned, sets `lights` to the bits of those that reach the point.
  Mask find(std::uint16_t number, Mask same, Float x, Float y, Int& lights) {
    const TrianglesInTile& group = group_[number / kWidth];
    const std::size_t lane = number % kWidth;
    const SettledPoints known = known_of(number);
    const bool from_front = (group.from_front >> lane & 1u) != 0;
    if (known.state == SettledPoints::State::asking) {
      settled_.ask(id_[number], count(same), std::min(as_uint32(kWidth), kManyInARow), from_front);
      return Mask::from_bits(0);
    }
    const Float above[3] = {group.above[0].value(lane, x, y), group.above[1].value(lane, x, y),
                            group.above[2].value(lane, x, y)};
    const Float total = group.total.value(lane, x, y);
    const Mask inside = same & (Float(0.0f) < min(min(above[0], above[1]), above[2])) &
                        (Float(group.least_total[lane]) < total);
    if (inside.bits() == 0) return inside;
    if (known.state == SettledPoints::State::settled) {
      lights = select(inside, Int(std::uint32_t{known.lights}), lights);
      return inside;
    }
    const Int parts = part_at(above[1] / total, above[2] / total);
    const Float footprint = Float(group.footprint[lane]) / (total * total);
    return find_parts(number, from_front, inside, parts, footprint, lights);
  }

  Mask find_parts(std::uint16_t number, bool from_front, Mask inside, Int parts, Float footprint,
                  Int& lights) {
    alignas(64) std::uint32_t part[kWidth], first[kWidth] = {}, more[kWidth] = {};
    parts.store(part);
    const SettledPoints whole = known_of(number);
    for (unsigned waiting = inside.bits(); waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const auto words = settled_.of_part(whole, part[lane]).words();
      first[lane] = words[0];
      more[lane] = words[1];
    }
    const Int known = Int::load(first);
    const auto word = [](SettledPoints::State state, bool front) {
      return Int(SettledPoints{.state = state, .from_front = front}.words()[0]);
    };
    const Mask asking = inside & (known == word(SettledPoints::State::asking, false));
    if (asking.bits() != 0)
      for_each_distinct(parts, asking, [&](std::uint32_t one, Mask in_part) {
        settled_.ask_part(id_[number], one, count(in_part), from_front);
      });
    const Int state_and_side = known & Int((1u << SettledPoints::kLightsBit) - 1);
    const Mask found = inside & (state_and_side == word(SettledPoints::State::settled, from_front)) &
                       (footprint < from_bits(Int::load(more)));
    lights = select(found, shift_in_zeros<SettledPoints::kLightsBit>(known), lights);
    return found;
  }

  struct Last {
    std::uint32_t id = kNoTriangle;
    std::uint16_t number = kNever;
  };
  // Pixels of a packet, side by side, that see the same triangle.
  struct Run {
    std::uint16_t first, number;  // the packet's first pixel; the triangle
    std::uint32_t lanes;
  };

  SettledTriangles& settled_;
  const SceneArrays& scene_;
  std::array<Last, 64> last_;  // by the lowest bits of their ids
  std::size_t count_ = 0, run_count_ = 0;
  std::array<Run, kPixels> run_;
  // By number; some numbers may be of the same triangle.
  std::array<std::uint32_t, kPixels> id_;
  std::array<std::uint64_t, kPixels> known_;  // SettledPoints, not initialised
  std::array<TrianglesInTile, kPixels / kWidth> group_;
};

std::size_t find_settled(SettledTriangles& settled, const SceneArrays& scene, const TileRays& rays,
                         std::uint32_t* ids, std::uint8_t* mask) {
  SettledInTile found(settled, scene);
  found.list(ids);
  found.meet(rays);
  found.write(ids, mask);
  constexpr std::size_t kPixels = std::size_t{1} << (2 * kTileBits);
  std::size_t reached = 0;
  for (std::size_t i = 0; i < kPixels; i += sizeof(std::uint64_t)) {
    std::uint64_t lights;
    std::memcpy(&lights, mask + i, sizeof lights);
    reached += as_size(__builtin_popcountll(lights));
  }
  return reached;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
