#include "core/trace/rays/alpha_threshold.h"

#include <bit>

#include "core/parallel/tiles.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

std::uint32_t mixed(std::uint32_t x) {  // Wellons 2018
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

}  // namespace

float threshold_of(const SamplePlace& place, std::uint32_t pixel, std::uint32_t triangle) {
  if (place.jitter == glm::vec2(0.0f)) return 0.5f;
  const auto mask = as_uint32(TileGrid::kTileSize - 1);
  std::uint32_t seed = std::bit_cast<std::uint32_t>(place.jitter.x);
  for (const std::uint32_t part :
       {std::bit_cast<std::uint32_t>(place.jitter.y), as_uint32(place.corner.x) + (pixel & mask),
        as_uint32(place.corner.y) + (pixel >> TileGrid::kTileBits & mask), triangle})
    seed = mixed(seed) + part;
  return as_float(mixed(seed) >> 8) * 0x1p-24f;
}

}  // namespace pinocchio
