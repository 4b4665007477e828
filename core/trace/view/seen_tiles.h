#pragma once

#include <cstddef>
#include <cstdint>

#include "core/parallel/tiles.h"
#include "core/shade/shared.h"
#include "pinocchio/bounds.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Columns and rows of a grid's tiles, half-open.
struct TileBox {
  glm::ivec2 lo, hi;
};
[[nodiscard]] TileBox all_tiles(const TileGrid& grid);
// The tiles around all those in which some ray may meet the box.
[[nodiscard]] TileBox tiles_that_may_see(const Bounds& box, const shared::ViewParams& view,
                                         const TileGrid& grid);

// Which tiles see a triangle, by given ids.
class SeenTiles {
 public:
  // The grid's pixels are every scale-th of `ids`, across and down. Both outlive this. No tile outside
  // `within` sees a triangle, and no id there is read.
  SeenTiles(const Image<std::uint32_t>& ids, int scale, const TileGrid& grid, const TileBox& within)
      : ids_(ids), scale_(scale), grid_(grid), within_(within) {}

  // True if some pixel of the tile sees a triangle.
  [[nodiscard]] bool any(std::size_t tile) const;

 private:
  const Image<std::uint32_t>& ids_;
  int scale_;
  const TileGrid& grid_;
  TileBox within_;
};

}  // namespace pinocchio
