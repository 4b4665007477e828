#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/parallel/tiles.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Which tiles see a triangle, by given ids. The first thread that asks for a tile reads the ids of its whole
// row of tiles, line by line of the picture: memory is fastest in that order.
class SeenTiles {
 public:
  // The grid's pixels are every scale-th of `ids`, across and down. Both outlive this.
  SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid);

  // True if some pixel of the tile sees a triangle. Thread-safe.
  [[nodiscard]] bool any(std::size_t tile);

 private:
  void read(std::size_t row);

  const Image<std::uint32_t>& ids_;
  int scale_;
  const TileGrid& grid_;
  std::unique_ptr<std::once_flag[]> is_read_;  // by row
  std::vector<std::uint32_t> all_;             // by tile: bitwise AND of its ids
};

}  // namespace pinocchio
