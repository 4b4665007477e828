#include "hybrid/exchange/reflection_tiles.h"

#include <algorithm>
#include <cassert>

#include "core/parallel/tiles.h"
#include "hybrid/exchange/encode.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

static_assert(TileGrid::kTileSize % kReflectionTile == 0, "each lies in one of the tracer's");

PixelBox box_of(std::size_t tile, int columns, glm::ivec2 size) {
  const glm::ivec2 cell(as_int(tile) % columns, as_int(tile) / columns);
  const glm::ivec2 lo = cell * kReflectionTile;
  return {lo, glm::min(lo + kReflectionTile, size)};
}

bool has_light(const Image<glm::vec3>& radiance, const PixelBox& box) {
  for (int y = box.lo.y; y < box.hi.y; ++y)
    for (int x = box.lo.x; x < box.hi.x; ++x)
      if (radiance.at(x, y) != glm::vec3(0.0f)) return true;
  return false;
}

}  // namespace

std::size_t most_tile_bytes(glm::ivec2 size, ReflectionFormat format) {
  if (format == ReflectionFormat::none) return 0;
  const glm::ivec2 tiles = tile_columns_rows(size);
  const auto count = as_size(tiles.x) * as_size(tiles.y);
  return count * (sizeof(std::uint32_t) + bytes_per_tile(format));
}

std::size_t pack_tiles(const Image<glm::vec3>& radiance, std::span<const std::uint8_t> black,
                       ReflectionFormat format, Workers& workers, std::vector<std::uint32_t>& index,
                       std::span<std::byte> to_gpu) {
  const glm::ivec2 grid = tile_columns_rows(radiance.size());
  index.resize(as_size(grid.x) * as_size(grid.y));
  assert(to_gpu.size() >= std::as_bytes(std::span(index)).size());
  const TileGrid traced(radiance.size());
  workers.for_each(index.size(), [&](std::size_t i) {
    const PixelBox box = box_of(i, grid.x, radiance.size());
    const bool known = !black.empty() && black[traced.tile_of(box.lo)] != 0;
    index[i] = !known && has_light(radiance, box) ? 0 : kNoTile;
  });
  std::uint32_t count = 0;
  for (std::uint32_t& entry : index)
    if (entry != kNoTile) entry = count++;
  std::ranges::copy(std::as_bytes(std::span(index)), to_gpu.begin());

  const std::span<std::byte> tiles = to_gpu.subspan(std::as_bytes(std::span(index)).size());
  const auto columns = as_size(grid.x);
  const std::size_t last_row = count / columns, in_last_row = count % columns;
  const Packing& pack = packing(format);
  const auto tile_row_bytes = as_size(kReflectionTile * bytes_per_pixel(format));
  workers.for_each(index.size(), [&](std::size_t i) {
    if (index[i] == kNoTile) return;
    const std::size_t row = index[i] / columns, column = index[i] % columns;
    const std::size_t width = row == last_row ? in_last_row : columns;
    std::byte* to = tiles.data() + row * columns * bytes_per_tile(format) + column * tile_row_bytes;
    const PixelBox box = box_of(i, grid.x, radiance.size());
    for (int y = box.lo.y; y < box.hi.y; ++y, to += width * tile_row_bytes)
      pack.pack({&radiance.at(box.lo.x, y), as_size(box.size().x)}, to);
  });
  return count;
}

}  // namespace pinocchio
