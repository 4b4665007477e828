#include "core/trace/view/seen_tiles.h"

#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {

SeenTiles::SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid)
    : ids_(ids),
      scale_(as_size(scale)),
      grid_(grid),
      is_read_(std::make_unique<std::once_flag[]>(grid.rows())),
      all_(grid.count(), kNoTriangle) {}

bool SeenTiles::any(std::size_t tile) {
  const std::size_t row = tile / grid_.columns();
  std::call_once(is_read_[row], [&] { read(row); });
  return all_[tile] != kNoTriangle;
}

void SeenTiles::read(std::size_t row) {
  const std::size_t first = row * grid_.columns();
  const PixelBox edge = grid_.tile(first);
  for (int y = edge.lo.y; y < edge.hi.y; ++y)
    for (std::size_t i = first; i < first + grid_.columns(); ++i) {
      const PixelBox tile = grid_.tile(i);
      const std::uint32_t* const ids = &ids_.at(tile.lo.x * as_int(scale_), y * as_int(scale_));
      std::uint32_t all = all_[i];
      if (scale_ == 1 && tile.size().x == TileGrid::kTileSize)  // in vectors
        for (int x = 0; x < TileGrid::kTileSize; ++x) all &= ids[x];
      else
        for (std::size_t x = 0; x < as_size(tile.size().x); ++x) all &= ids[x * scale_];
      all_[i] = all;
    }
}

}  // namespace pinocchio
