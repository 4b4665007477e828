#include "core/trace/view/seen_tiles.h"

#include <algorithm>

#include "core/trace/view/tile_frustum.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

// Bitwise AND of the ids in a line of a whole tile.
std::uint32_t all_of_line(const std::uint32_t* ids) {
  std::uint32_t all = kNoTriangle;
  for (int x = 0; x < TileGrid::kTileSize; ++x) all &= ids[x];  // in vectors
  return all;
}

}  // namespace

PixelBox part_that_may_see(const Bounds& box, const shared::ViewParams& view, glm::ivec2 size) {
  PixelBox part{{0, 0}, size};
  for (int axis : {0, 1}) {
    int &lo = part.lo[axis], &hi = part.hi[axis];
    const auto misses = [&](int from, int to) {  // a column or row of tiles
      PixelBox line{{0, 0}, size};
      line.lo[axis] = from;
      line.hi[axis] = to;
      return TileFrustum(view, line).misses(box);
    };
    constexpr int kSide = TileGrid::kTileSize;
    while (lo < hi && misses(lo, std::min(lo + kSide, hi))) lo += kSide;
    while (lo < hi && misses((hi - 1) / kSide * kSide, hi)) hi = (hi - 1) / kSide * kSide;
  }
  return part;
}

bool SeenTiles::any(std::size_t tile) const {
  const PixelBox box = grid_.tile(tile);
  if (glm::any(glm::lessThan(box.lo, within_.lo)) || !glm::all(glm::lessThan(box.lo, within_.hi)))
    return false;
  const bool whole_lines = scale_ == 1 && box.size().x == TileGrid::kTileSize;
  std::uint32_t all = kNoTriangle;
  for (int y = box.lo.y; y < box.hi.y; ++y) {
    const std::uint32_t* const ids = &ids_.at(box.lo.x * scale_, y * scale_);
    if (whole_lines)
      all &= all_of_line(ids);
    else
      for (int x = 0; x < box.size().x; ++x) all &= ids[x * scale_];
  }
  return all != kNoTriangle;
}

}  // namespace pinocchio
