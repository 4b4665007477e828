#include "core/trace/view/seen_tiles.h"

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

TileBox all_tiles(const TileGrid& grid) {
  return {glm::ivec2(0), glm::ivec2(grid.columns(), grid.rows())};
}

TileBox tiles_that_may_see(const Bounds& box, const shared::ViewParams& view, const TileGrid& grid) {
  TileBox tiles = all_tiles(grid);
  const auto miss = [&](glm::ivec2 lo, glm::ivec2 hi) {
    return TileFrustum(view, {TileGrid::kTileSize * lo, TileGrid::kTileSize * hi}).misses(box);
  };
  for (int axis : {0, 1}) {
    int &lo = tiles.lo[axis], &hi = tiles.hi[axis];
    const auto line_misses = [&](int i) {  // the column or row
      TileBox line = all_tiles(grid);
      line.lo[axis] = i;
      line.hi[axis] = i + 1;
      return miss(line.lo, line.hi);
    };
    while (lo < hi && line_misses(lo)) ++lo;
    while (lo < hi && line_misses(hi - 1)) --hi;
  }
  return tiles;
}

bool SeenTiles::any(std::size_t tile) const {
  const PixelBox box = grid_.tile(tile);
  const glm::ivec2 at = box.lo / TileGrid::kTileSize;
  if (glm::any(glm::lessThan(at, within_.lo)) || !glm::all(glm::lessThan(at, within_.hi))) return false;
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
