// Part of walk/kernel.h's files: pixels that need no step, as all is known of the points that they see.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/trace/lanes/in_triangle.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/settled/settled_triangles.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The triangles that the pixels of a tile see, as far as they may be settled.
class SettledInTile {
 public:
  SettledInTile(SettledTriangles& settled, const SceneArrays& scene) : settled_(settled), scene_(scene) {}

  // The number of a triangle here; kNever: it is not settled.
  static constexpr std::uint16_t kNever = 0xffff;
  [[nodiscard]] std::uint16_t number_of(std::uint32_t id) {
    Last& last = last_[id % last_.size()];
    if (last.id != id) last = {id, add(id)};
    return last.number;
  }

  // Where rays meet those that have numbers.
  void find_triangles(const TileRays& rays) {
    for (std::size_t first = 0; first < count_; first += kWidth) {
      const std::size_t lanes = std::min(std::size_t{kWidth}, count_ - first);
      TrianglesInTile& group = groups_[first / kWidth];
      for (std::size_t lane = lanes; lane < kWidth; ++lane)
        group.set_corners(lane, glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f));
      group.find(rays);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const SettledPoints& known = known_[first + lane];
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

  // The lanes of which all is known. `same` see the triangle of that number, in the pixels (x, y). In the
  // lanes that are returned, sets `lights` to the bits of those that reach the point.
  Mask find(std::uint16_t number, Mask same, Float x, float y, Int& lights) {
    const TrianglesInTile& group = groups_[number / kWidth];
    const std::size_t lane = number % kWidth;
    const SettledPoints& known = known_[number];
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
    const Float longest = Float(group.footprint[lane]) / (total * total);
    return find_parts(number, from_front, inside, part_at(above[1] / total, above[2] / total), longest,
                      lights);
  }

 private:
  // Triangles of which a row of a packet sees as many pixels are large enough for parts.
  static constexpr unsigned kManyInARow = 8;
  static constexpr std::size_t kMost = std::size_t{1} << (2 * kTileBits);  // one for each pixel

  static unsigned count(Mask lanes) { return as_uint32(__builtin_popcount(lanes.bits())); }

  std::uint16_t add(std::uint32_t id) {
    const SettledPoints known = settled_.of(id);
    if (known.state == SettledPoints::State::never) return kNever;
    id_[count_] = id;
    known_[count_] = known;
    const glm::uvec3& corners = scene_.triangles[id];
    groups_[count_ / kWidth].set_corners(count_ % kWidth, scene_.positions[corners.x],
                                         scene_.positions[corners.y], scene_.positions[corners.z]);
    return static_cast<std::uint16_t>(count_++);
  }

  Mask find_parts(std::uint16_t number, bool from_front, Mask inside, Int parts, Float longest, Int& lights) {
    alignas(64) std::uint32_t part[kWidth], first[kWidth] = {}, more[kWidth] = {};
    parts.store(part);
    for (unsigned waiting = inside.bits(); waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const auto words = settled_.of_part(known_[number], part[lane]).words();
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
                       (longest < from_bits(Int::load(more)));
    lights = select(found, shift_in_zeros<SettledPoints::kLightsBit>(known), lights);
    return found;
  }

  struct Last {
    std::uint32_t id = kNoTriangle;
    std::uint16_t number = kNever;
  };

  SettledTriangles& settled_;
  const SceneArrays& scene_;
  std::array<Last, 64> last_;  // by the lowest bits of their ids
  std::size_t count_ = 0;
  // By number; numbers may repeat a triangle.
  std::array<std::uint32_t, kMost> id_;
  std::array<SettledPoints, kMost> known_;
  std::array<TrianglesInTile, kMost / kWidth> groups_;
};

// The lanes of the packet from numbers[i] on whose number is not the one before, and the first lane.
inline unsigned begins_of_runs(const std::uint32_t* numbers, std::size_t i) {
  if (i > 0) return (~(Int::load(numbers + i) == Int::load_unaligned(numbers + i - 1))).bits() | 1u;
  unsigned begins = 1;
  for (std::size_t k = 1; k < kWidth; ++k) begins |= numbers[k] != numbers[k - 1] ? 1u << k : 0u;
  return begins;
}

std::size_t find_settled(SettledTriangles& settled, const SceneArrays& scene, const TileRays& rays,
                         std::uint32_t* ids, std::uint8_t* mask) {
  constexpr std::size_t kSide = std::size_t{1} << kTileBits;
  alignas(64) std::uint32_t numbers[kWidth];
  std::iota(numbers, numbers + kWidth, 0u);
  const Float lane = to_float(Int::load(numbers));
  const Int none(kNoTriangle);
  struct Seen {  // by a packet
    std::uint16_t first, triangle;
    std::uint32_t lanes;
  };
  std::array<Seen, kSide * kSide> seen;
  std::size_t count = 0;
  SettledInTile triangles(settled, scene);
  for (std::size_t i = 0; i < kSide * kSide; i += kWidth) {
    const Int triangle = Int::load(ids + i);
    if ((~(triangle == none)).bits() == 0) continue;
    unsigned begins = begins_of_runs(ids, i);
    while (begins != 0) {
      const int begin = __builtin_ctz(begins);
      begins &= begins - 1;
      const int end = begins == 0 ? kWidth : __builtin_ctz(begins);
      const std::uint32_t id = ids[i + as_size(begin)];
      if (id == kNoTriangle) continue;
      const std::uint16_t number = triangles.number_of(id);
      if (number != SettledInTile::kNever)
        seen[count++] = {static_cast<std::uint16_t>(i), number, (1u << end) - (1u << begin)};
    }
  }
  triangles.find_triangles(rays);
  for (std::size_t s = 0; s < count;) {
    const std::size_t i = seen[s].first;
    const Float x = lane + Float(as_float(i % kSide));
    Mask found = Mask::from_bits(0);
    Int lights(0u);
    for (; s < count && seen[s].first == i; ++s)
      found = found | triangles.find(seen[s].triangle, Mask::from_bits(seen[s].lanes), x, as_float(i / kSide),
                                     lights);
    if (found.bits() == 0) continue;
    select(found, none, Int::load(ids + i)).store(ids + i);
    alignas(64) std::uint32_t bits[kWidth];
    lights.store(bits);
    std::uint8_t* const to = mask + i;
    for (std::size_t k = 0; k < kWidth; ++k) to[k] = static_cast<std::uint8_t>(bits[k]);
  }
  std::size_t reached = 0;
  for (std::size_t i = 0; i < kSide * kSide; i += sizeof(std::uint64_t)) {
    std::uint64_t lights;
    std::memcpy(&lights, mask + i, sizeof lights);
    reached += as_size(__builtin_popcountll(lights));
  }
  return reached;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
