#pragma once

#include <bit>
#include <cstddef>
#include <glm/glm.hpp>

#include "pinocchio/conversion.h"
#include "pinocchio/pixel_box.h"

namespace pinocchio {

// Cuts a picture into square tiles, row by row: the unit of work of a thread and of ray coherence.
class TileGrid {
 public:
  static constexpr int kTileBits = 5, kTileSize = 1 << kTileBits;

  explicit TileGrid(glm::ivec2 size) : size_(size), tiles_((size + kTileSize - 1) / kTileSize) {}

  [[nodiscard]] std::size_t columns() const { return as_size(tiles_.x); }
  [[nodiscard]] std::size_t rows() const { return as_size(tiles_.y); }
  [[nodiscard]] std::size_t count() const { return std::size_t(tiles_.x) * tiles_.y; }
  [[nodiscard]] std::size_t tile_of(glm::ivec2 pixel) const {
    const glm::ivec2 cell = pixel / kTileSize;
    return std::size_t(cell.y) * tiles_.x + cell.x;
  }
  [[nodiscard]] PixelBox tile(std::size_t i) const {
    const std::size_t row_length = tiles_.x;
    const glm::ivec2 cell(i % row_length, i / row_length);
    const glm::ivec2 lo = cell * kTileSize;
    return {lo, glm::min(lo + kTileSize, size_)};
  }

  // Calls visit(x, y) for every pixel of `box`, no larger than a tile, along a Z curve: 4, 8, 16 or 64 in a
  // row are neighbours in the picture, whatever the width of a packet.
  template <class Visit>
  static void for_each_pixel(const PixelBox& box, Visit visit) {
    const glm::ivec2 size = box.size();
    const unsigned longer = size.x > size.y ? size.x : size.y;
    const int side = std::bit_ceil(longer);
    for (int i = 0; i < side * side; ++i) {
      const int x = box.lo.x + even_bits(i), y = box.lo.y + even_bits(i >> 1);
      if (x < box.hi.x && y < box.hi.y) visit(x, y);
    }
  }

 private:
  static_assert(kTileSize == 32);
  // Bits 0, 2, 4, 6 and 8 of i, side by side.
  static constexpr int even_bits(int i) {
    i &= 0x155;
    i = (i | i >> 1) & 0x133;
    i = (i | i >> 2) & 0x10f;
    return (i | i >> 4) & 0x1f;
  }

  glm::ivec2 size_;
  glm::ivec2 tiles_;
};

}  // namespace pinocchio
