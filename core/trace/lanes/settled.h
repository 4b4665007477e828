// Part of walk/kernel.h's files: what needs no step, as a ray met nothing, or all is known of the point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/trace/lanes/lane_steps.h"
#include "core/trace/lanes/triangle_part.h"
#include "core/trace/settled/settled_triangles.h"
#include "core/trace/settled/triangle_in_tile.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

void keep_hits(RayQueue& rays) {
  const Int none(kNoTriangle);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Mask in_queue = lanes_from(i, rays.size), hit = in_queue & ~(Int::load(rays.triangle + i) == none);
    if (hit.bits() != 0 && (kept < i || hit.bits() != in_queue.bits())) {
      for (float* const* columns : {rays.origin, rays.direction, rays.light})
        for (int axis = 0; axis < 3; ++axis)
          store_packed(columns[axis] + kept, Float::load(columns[axis] + i), hit);
      store_packed(rays.pixel + kept, Int::load(rays.pixel + i), hit);
      if (rays.width) store_packed(rays.width + kept, Float::load(rays.width + i), hit);
      if (rays.density) store_packed(rays.density + kept, Float::load(rays.density + i), hit);
      if (rays.way) store_packed(rays.way + kept, Float::load(rays.way + i), hit);
      if (rays.medium) store_packed(rays.medium + kept, Int::load(rays.medium + i), hit);
      store_packed(rays.triangle + kept, Int::load(rays.triangle + i), hit);
    }
    kept += as_size(__builtin_popcount(hit.bits()));
  }
  rays.size = kept;
}

// The triangles that the pixels of a tile see, as far as they may be settled.
class SettledInTile {
 public:
  SettledInTile(SettledTriangles& settled, const SceneArrays& scene, const TileRays& rays)
      : settled_(settled), scene_(scene), rays_(rays) {}

  // The lanes of which all is known. `same` see this triangle, in the pixels (x, y). In the lanes that are
  // returned, sets `lights` to the bits of those that reach the point.
  Mask find(std::uint32_t id, Mask same, Float x, float y, Int& lights) {
    const Seen& seen = seen_[id % seen_.size()].id == id ? seen_[id % seen_.size()] : look_up(id);
    if (seen.known.state == SettledPoints::State::never) return Mask::from_bits(0);
    const TriangleInTile& at = seen.triangle;
    const Float above[3] = {value(at.above[0], x, y), value(at.above[1], x, y), value(at.above[2], x, y)};
    const Float total = value(at.total, x, y);
    const Mask inside =
        same & (Float(0.0f) < min(min(above[0], above[1]), above[2])) & (Float(seen.least_total) < total);
    if (inside.bits() == 0) return inside;
    if (seen.known.state == SettledPoints::State::settled) {
      lights = select(inside, Int(std::uint32_t{seen.known.lights}), lights);
      return inside;
    }
    if (seen.known.state == SettledPoints::State::by_part)
      return find_parts(seen, inside, part_at(above[1] / total, above[2] / total), total, lights);
    settled_.ask(id, count(inside), std::min(as_uint32(kWidth), kManyInARow), at.from_front);
    return Mask::from_bits(0);
  }

 private:
  // Triangles of which a row of a packet sees as many pixels are large enough for parts.
  static constexpr unsigned kManyInARow = 8;

  struct Seen {
    std::uint32_t id = kNoTriangle;
    float least_total = 0.0f;
    SettledPoints known;
    TriangleInTile triangle;
  };

  static unsigned count(Mask lanes) { return as_uint32(__builtin_popcount(lanes.bits())); }
  static Float value(const LinearInPixel& number, Float x, float y) {
    return Float(number.at + number.per_y * y) + Float(number.per_x) * x;
  }

  const Seen& look_up(std::uint32_t id) {
    Seen& seen = seen_[id % seen_.size()];
    seen.id = id;
    seen.known = settled_.of(id);
    if (seen.known.state == SettledPoints::State::never) return seen;
    const glm::uvec3& corners = scene_.triangles[id];
    seen.triangle = TriangleInTile(
        rays_, {scene_.positions[corners.x], scene_.positions[corners.y], scene_.positions[corners.z]});
    seen.least_total = seen.triangle.least_total;
    if (seen.known.state == SettledPoints::State::by_part)
      seen.least_total = std::max(seen.least_total, seen.triangle.least_for_parts);
    if (seen.known.state != SettledPoints::State::settled) return seen;
    if (seen.known.from_front != seen.triangle.from_front) seen.known.state = SettledPoints::State::never;
    if (seen.known.rough_within() < kInfinity)
      seen.least_total =
          std::max(seen.least_total, std::sqrt(seen.triangle.footprint / seen.known.rough_within()));
    return seen;
  }

  Mask find_parts(const Seen& seen, Mask inside, Int parts, Float total, Int& lights) {
    alignas(64) std::uint32_t part[kWidth], first[kWidth] = {}, more[kWidth] = {};
    parts.store(part);
    for (unsigned waiting = inside.bits(); waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const auto words = settled_.of_part(seen.known, part[lane]).words();
      first[lane] = words[0];
      more[lane] = words[1];
    }
    const Int known = Int::load(first);
    const auto word = [](SettledPoints::State state, bool from_front) {
      return Int(SettledPoints{.state = state, .from_front = from_front}.words()[0]);
    };
    const Mask asking = inside & (known == word(SettledPoints::State::asking, false));
    if (asking.bits() != 0)
      for_each_distinct(parts, asking, [&](std::uint32_t one, Mask in_part) {
        settled_.ask_part(seen.id, one, count(in_part), seen.triangle.from_front);
      });
    const Int state_and_side = known & Int((1u << SettledPoints::kLightsBit) - 1);
    const Float rough_within = from_bits(Int::load(more));
    const Mask found = inside &
                       (state_and_side == word(SettledPoints::State::settled, seen.triangle.from_front)) &
                       (Float(seen.triangle.footprint) < rough_within * (total * total));
    lights = select(found, shift_in_zeros<SettledPoints::kLightsBit>(known), lights);
    return found;
  }

  SettledTriangles& settled_;
  const SceneArrays& scene_;
  const TileRays& rays_;
  std::array<Seen, 64> seen_;  // by the lowest bits of their ids
};

std::size_t find_settled(SettledTriangles& settled, const SceneArrays& scene, const TileRays& rays,
                         std::uint32_t* ids, std::uint8_t* mask) {
  constexpr std::size_t kSide = std::size_t{1} << kTileBits;
  alignas(64) std::uint32_t numbers[kWidth];
  std::iota(numbers, numbers + kWidth, 0u);
  const Float lane = to_float(Int::load(numbers));
  const Int none(kNoTriangle);
  SettledInTile triangles(settled, scene, rays);
  for (std::size_t i = 0; i < kSide * kSide; i += kWidth) {
    const Int triangle = Int::load(ids + i);
    const Mask sees = ~(triangle == none);
    if (sees.bits() == 0) continue;
    const Float x = lane + Float(as_float(i % kSide));
    Mask found = Mask::from_bits(0);
    Int lights(0u);
    for_each_distinct(triangle, sees, [&](std::uint32_t id, Mask same) {
      found = found | triangles.find(id, same, x, as_float(i / kSide), lights);
    });
    if (found.bits() == 0) continue;
    select(found, none, triangle).store(ids + i);
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
