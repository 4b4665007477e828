#include "core/trace/rays/ray_sorter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr unsigned kGrid = 8;                             // cells along an axis
constexpr std::size_t kKeys = 8 * kGrid * kGrid * kGrid;  // octants times cells

unsigned octant_of(const RayColumns& rays, std::size_t i) {
  unsigned octant = 0;
  for (unsigned axis = 0; axis < 3; ++axis) octant |= (rays.direction[axis][i] < 0.0f ? 1u : 0u) << axis;
  return octant;
}

// The three bits of a cell's coordinate, two apart.
constexpr std::array<std::uint16_t, kGrid> kSpread{0, 1, 8, 9, 64, 65, 72, 73};

// Origins as coordinates in the grid.
struct Grid {
  float lo[3], scale[3];

  // The grid around every `step`-th ray.
  Grid(const RayColumns& rays, std::size_t n, std::size_t step) {
    for (int axis = 0; axis < 3; ++axis) {
      const float* const origin = rays.origin[axis];
      float least = origin[0], most = origin[0];
      for (std::size_t i = 0; i < n; i += step) {
        least = std::min(least, origin[i]);
        most = std::max(most, origin[i]);
      }
      lo[axis] = least;
      const float extent = most - least;
      scale[axis] = extent > 0.0f && std::isfinite(extent) ? kGrid / extent : 0.0f;
    }
  }
  // Any cell for a ray that cannot be traced.
  [[nodiscard]] unsigned cell(int axis, float origin) const {
    const float at = (origin - lo[axis]) * scale[axis];
    return at > 0.0f ? static_cast<unsigned>(std::min(at, kGrid - 1.0f)) : 0u;
  }
};

}  // namespace

bool sorting_pays(const RayColumns& rays, std::size_t n) {
  constexpr std::size_t kSamples = 32;
  constexpr std::size_t kMost = kSamples * 3 / 10;  // pairs of neighbours with other keys
  const std::size_t step = std::max<std::size_t>(n / kSamples, 2);
  const Grid grid(rays, n, step);
  std::size_t others = 0;
  for (std::size_t i = 0; i + 1 < n; i += step) {
    bool apart = octant_of(rays, i) != octant_of(rays, i + 1);
    for (int axis = 0; axis < 3 && !apart; ++axis)
      apart = std::abs(rays.origin[axis][i + 1] - rays.origin[axis][i]) * grid.scale[axis] > 1.0f;
    others += apart ? 1 : 0;
  }
  return others > kMost;
}

void RaySorter::find_order(const RayColumns& rays, std::size_t n) {
  const Grid grid(rays, n, 1);
  std::array<std::uint32_t, kKeys + 1> first{};
  for (std::size_t i = 0; i < n; ++i) {
    unsigned key = octant_of(rays, i) << 9;
    for (int axis = 0; axis < 3; ++axis) key |= kSpread[grid.cell(axis, rays.origin[axis][i])] << axis;
    key_[i] = static_cast<std::uint16_t>(key);
    ++first[key + 1];
  }
  for (std::size_t key = 0; key < kKeys; ++key) first[key + 1] += first[key];
  for (std::size_t i = 0; i < n; ++i) from_[first[key_[i]]++] = as_uint32(i);
}

RayColumns RaySorter::sort(const RayColumns& rays, std::size_t n) {
  key_.resize(n);
  from_.resize(n);
  if (triangle_.size() < n + kQueuePad) {
    triangle_.resize(n + kQueuePad);
    blocked_.resize(n + kQueuePad);
    for (AlignedVector<float>& column : column_) column.resize(n + kQueuePad);
  }
  find_order(rays, n);
  const float* const source[7] = {rays.origin[0],    rays.origin[1],    rays.origin[2], rays.direction[0],
                                  rays.direction[1], rays.direction[2], rays.t_max};
  for (std::size_t c = 0; c < 7; ++c)
    if (source[c])
      for (std::size_t i = 0; i < n; ++i) column_[c][i] = source[c][from_[i]];
  const auto column = [this](std::size_t i) { return column_[i].data(); };
  return {{column(0), column(1), column(2)},
          {column(3), column(4), column(5)},
          rays.t_max ? column(6) : nullptr,
          rays.reach};
}

void RaySorter::put_back(std::uint32_t* triangle, float* t) const {
  for (std::size_t i = 0; i < from_.size(); ++i) triangle[from_[i]] = triangle_[i];
  if (t)
    for (std::size_t i = 0; i < from_.size(); ++i) t[from_[i]] = column_[7][i];
}

void RaySorter::put_back(std::uint8_t* blocked) const {
  for (std::size_t i = 0; i < from_.size(); ++i) blocked[from_[i]] = blocked_[i];
}

}  // namespace pinocchio
