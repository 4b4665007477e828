#include "core/scene/least_green.h"

#include <algorithm>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using GreenImage = Image<std::uint8_t>;

// Squares that the texels from `first` to `last` of a side of `texels` are in, where they may be beyond the
// side's ends by less than its length: calls visit(square), for some more than once.
template <class Visit>
void for_each_square(int first, int last, int texels, int side, Visit visit) {
  const auto within = [&](int begin, int end) {
    for (int i = begin / side; i <= end / side; ++i) visit(i);
  };
  within(std::max(first, 0), std::min(last, texels - 1));
  if (first < 0) within(texels + first, texels - 1);
  if (last >= texels) within(0, last - texels);
}

constexpr int kSide = Texture::kGreenSide;

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

// With the texels up to `reach` around each square.
GreenImage with_neighbours(const GreenImage& squares, glm::ivec2 texels, int reach) {
  GreenImage rows(squares.size(), 255);
  for (int x = 0; x < rows.width(); ++x)
    for_each_square(x * kSide - reach, (x + 1) * kSide - 1 + reach, texels.x, kSide, [&](int from) {
      for (int y = 0; y < rows.height(); ++y) rows.at(x, y) = std::min(rows.at(x, y), squares.at(from, y));
    });
  GreenImage all(squares.size(), 255);
  for (int y = 0; y < rows.height(); ++y)
    for_each_square(y * kSide - reach, (y + 1) * kSide - 1 + reach, texels.y, kSide, [&](int from) {
      for (int x = 0; x < rows.width(); ++x) all.at(x, y) = std::min(all.at(x, y), rows.at(x, from));
    });
  return all;
}

}  // namespace

void find_least_green(Texture& texture) {
  const glm::ivec2 size = texture.texels.size();
  if (std::min(size.x, size.y) < 64) return;
  const GreenImage squares = least_of_squares(texture.texels);
  texture.least_green.assign(squares.pixels().size(), 0u);
  for (int k = 0; k < Texture::kGreenReaches; ++k) {
    const GreenImage least = with_neighbours(squares, size, kSide << k);
    for (std::size_t i = 0; i < least.pixels().size(); ++i)
      texture.least_green[i] |= as_uint32(least[i]) << 8 * k;
  }
}

}  // namespace pinocchio
