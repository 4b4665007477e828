#pragma once

#include <cstddef>
#include <cstdint>

#include "core/parallel/tiles.h"
#include "core/shade/shared.h"
#include "pinocchio/bounds.h"
#include "pinocchio/image.h"
#include "pinocchio/pixel_box.h"

namespace pinocchio {

// A part of a picture of `size` pixels: no ray outside it meets the box. It is made of whole tiles.
[[nodiscard]] PixelBox part_that_may_see(const Bounds& box, const shared::ViewParams& view, glm::ivec2 size);

// Which tiles see a triangle, by given ids.
class SeenTiles {
 public:
  // The grid's pixels are every scale-th of `ids`, across and down. Both outlive this. No pixel outside
  // `within`, which is made of whole tiles, sees a triangle, and no id there is read.
  SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid, const PixelBox& within)
      : ids_(ids), scale_(scale), grid_(grid), within_(within) {}

  // True if some pixel of the tile sees a triangle.
  [[nodiscard]] bool any(std::size_t tile) const;

 private:
  const Image<std::uint32_t>& ids_;
  int scale_;
  const TileGrid& grid_;
  PixelBox within_;
};

}  // namespace pinocchio
