#include "core/scene/least_green.h"

#include <algorithm>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using GreenImage = Image<std::uint8_t>;

constexpr int kSide = Texture::kGreenSide;

struct Source {
  int square, from;
};

// For each square along a side of `texels`: the squares that hold its own texels, and the texels `way` before
// and behind them. Beyond an end the side repeats.
std::vector<Source> sources_of(int texels, int way) {
  std::vector<Source> sources;
  for (int square = 0; square * kSide < texels; ++square)
    for (const int offset : {-way, 0, way})
      for (int i = 0; i < kSide; ++i) {
        const int from = (square * kSide + offset + i + texels) % texels / kSide;
        if (i == 0 || from != sources.back().from) sources.push_back({square, from});
      }
  return sources;
}

// The least of each square.
GreenImage least_of_squares(const Image<glm::u8vec4>& texels) {
  GreenImage least((texels.size() + kSide - 1) / kSide, 255);
  for (int y = 0; y < texels.height(); ++y)
    for (int x = 0; x < texels.width(); ++x) {
      std::uint8_t& of = least.at(x / kSide, y / kSide);
      of = std::min(of, texels.at(x, y).g);
    }
  return least;
}

// The least of each square and of those `way` texels from it, across, down and both.
GreenImage least_around(const GreenImage& squares, glm::ivec2 texels, int way) {
  GreenImage rows(squares.size(), 255), all(squares.size(), 255);
  const std::vector<Source> across = sources_of(texels.x, way), down = sources_of(texels.y, way);
  for (int y = 0; y < rows.height(); ++y)
    for (const auto& [x, from] : across) rows.at(x, y) = std::min(rows.at(x, y), squares.at(from, y));
  for (const auto& [y, from] : down)
    for (int x = 0; x < all.width(); ++x) all.at(x, y) = std::min(all.at(x, y), rows.at(x, from));
  return all;
}

}  // namespace

void find_least_green(Texture& texture) {
  const glm::ivec2 size = texture.texels.size();
  if (std::min(size.x, size.y) < 64) return;
  GreenImage least = least_of_squares(texture.texels);
  texture.least_green.assign(least.pixels().size(), 0u);
  for (int k = 0; k < Texture::kGreenReaches; ++k) {
    // Each holds the least as far around it as the next ones are away.
    least = least_around(least, size, kSide << std::max(k - 1, 0));
    for (std::size_t i = 0; i < least.pixels().size(); ++i)
      texture.least_green[i] |= as_uint32(least[i]) << 8 * k;
  }
}

}  // namespace pinocchio
