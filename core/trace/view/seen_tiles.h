#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/parallel/tiles.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Which tiles of given ids see anything. A row of tiles is read as a whole by the first thread that asks for
// one of it: line by line of the picture, as memory is read fastest.
class SeenTiles {
 public:
  // Every scale-th pixel of `ids`, which outlives this, is one of the grid's.
  SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid);

  // Whether some pixel of the tile sees something. From any thread.
  [[nodiscard]] bool any(std::size_t tile);

 private:
  void read(std::size_t row);

  const Image<std::uint32_t>& ids_;
  std::size_t scale_;
  const TileGrid& grid_;
  std::unique_ptr<std::once_flag[]> is_read_;  // by row
  std::vector<std::uint32_t> all_;             // by tile: the bits that its ids have in common
};

}  // namespace pinocchio
