#pragma once

#include <glm/glm.hpp>
#include <cstddef>

namespace pinocchio {

// Half-open box of pixels.
struct PixelBox {
  glm::ivec2 lo{0, 0};
  glm::ivec2 hi{0, 0};

  [[nodiscard]] glm::ivec2 size() const { return hi - lo; }
  [[nodiscard]] bool empty() const { return hi.x <= lo.x || hi.y <= lo.y; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

// Cuts a picture into square tiles, row by row: the unit of work of a thread and of ray coherence.
class TileGrid {
 public:
  static constexpr int kTileSize = 32;

  explicit TileGrid(glm::ivec2 size) : size_(size), tiles_((size + kTileSize - 1) / kTileSize) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y);
  }
  [[nodiscard]] PixelBox tile(std::size_t i) const {
    const int row_length = tiles_.x;
    const glm::ivec2 cell(static_cast<int>(i) % row_length, static_cast<int>(i) / row_length);
    const glm::ivec2 lo = cell * kTileSize;
    return {lo, glm::min(lo + kTileSize, size_)};
  }

  // Calls visit(x, y) for every pixel of `box`, 2x2 quads together, so that four rays in a row are
  // neighbours in the picture.
  template <class Visit>
  static void for_each_pixel(const PixelBox& box, Visit visit) {
    for (int y = box.lo.y; y < box.hi.y; y += 2)
      for (int x = box.lo.x; x < box.hi.x; x += 2)
        for (int k = 0; k < 4; ++k) {
          const int px = x + (k & 1), py = y + (k >> 1);
          if (px < box.hi.x && py < box.hi.y) visit(px, py);
        }
  }

 private:
  glm::ivec2 size_;
  glm::ivec2 tiles_;
};

}  // namespace pinocchio
