// A reflection image of which only the tiles with some light travel: an index with each tile's place, and the
// tiles one after the other. The GPU keeps them in a texture of the whole picture's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/parallel/workers.h"
#include "pinocchio/conversion.h"
#include "pinocchio/image.h"
#include "pinocchio/settings.h"

namespace pinocchio {

inline constexpr int kReflectionTile = 8;             // pixels a side
inline constexpr std::uint32_t kNoTile = 0xffffffff;  // in the index: all of the tile is black

// How many tiles cover a picture.
[[nodiscard]] inline glm::ivec2 tile_columns_rows(glm::ivec2 size) {
  return (size + kReflectionTile - 1) / kReflectionTile;
}

// One tile's bytes, whole at the picture's edges too.
[[nodiscard]] inline std::size_t bytes_per_tile(ReflectionFormat format) {
  return as_size(kReflectionTile * kReflectionTile * bytes_per_pixel(format));
}

// Bytes of index and tiles where every tile has light; 0 without a reflection.
[[nodiscard]] std::size_t most_tile_bytes(glm::ivec2 size, ReflectionFormat format);

// Packs the image, linear light: the index (tile_columns_rows(), row by row), then the tiles as rows of the
// texture, tile_columns_rows().x tiles wide; the last row has the tiles that are left. Returns how many tiles
// were written. `to_gpu` is only written, as it is mapped for writing; the index is built in `index`, whose
// memory the caller keeps from frame to frame.
// black: the tracer's tiles (TileOutputs::black_tiles) that are known to be black; empty: none is.
std::size_t pack_tiles(const Image<glm::vec3>& radiance, std::span<const std::uint8_t> black,
                       ReflectionFormat format, Workers& workers, std::vector<std::uint32_t>& index,
                       std::span<std::byte> to_gpu);

}  // namespace pinocchio
