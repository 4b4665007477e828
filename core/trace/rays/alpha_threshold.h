#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace pinocchio {

struct SamplePlace {
  glm::ivec2 corner;  // of the tile, in the picture
  glm::vec2 jitter;   // zero: the only sample, or the first
};

// The alpha below which a surface that blends lets the shadow ray of that pixel of the tile pass: one half,
// or, in further samples of a pixel, a random number. It is the same whatever part of the picture is drawn,
// and however it is cut in tiles.
[[nodiscard]] float threshold_of(const SamplePlace& place, std::uint32_t pixel, std::uint32_t triangle);

}  // namespace pinocchio
