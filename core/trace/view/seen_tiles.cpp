#include "core/trace/view/seen_tiles.h"

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

SeenTiles::SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid)
    : ids_(ids),
      scale_(scale),
      grid_(grid),
      is_read_(std::make_unique<std::once_flag[]>(grid.rows())),
      all_(grid.count(), kNoTriangle) {}

bool SeenTiles::any(std::size_t tile) {
  const std::size_t row = tile / grid_.columns();
  std::call_once(is_read_[row], [&] { read(row); });
  return all_[tile] != kNoTriangle;
}

void SeenTiles::read(std::size_t row) {
  const std::size_t first = row * grid_.columns(), end = first + grid_.columns();
  const PixelBox edge = grid_.tile(end - 1);
  const std::size_t whole_end = first + (scale_ == 1 ? as_size(edge.hi.x) / TileGrid::kTileSize : 0);
  for (int y = edge.lo.y; y < edge.hi.y; ++y) {
    const std::uint32_t* line = &ids_.at(0, y * scale_);
    for (std::size_t i = first; i < whole_end; ++i, line += TileGrid::kTileSize) all_[i] &= all_of_line(line);
    for (std::size_t i = whole_end; i < end; ++i) {
      const PixelBox tile = grid_.tile(i);
      for (int x = tile.lo.x; x < tile.hi.x; ++x) all_[i] &= ids_.at(x * scale_, y * scale_);
    }
  }
}

}  // namespace pinocchio
