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

int squares_of(int texels, int side) {
  return (texels + side - 1) / side;
}

// The least of each square of `from`.
GreenImage least_of_squares(const GreenImage& from, int side) {
  GreenImage to({squares_of(from.width(), side), squares_of(from.height(), side)}, 255);
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x) {
      std::uint8_t& least = to.at(x / side, y / side);
      least = std::min(least, from.at(x, y));
    }
  return to;
}

// With the texels up to a square's side around each.
std::vector<float> with_neighbours(const GreenImage& squares, glm::ivec2 texels, int side) {
  GreenImage rows(squares.size(), 255);
  for (int x = 0; x < rows.width(); ++x)
    for_each_square((x - 1) * side, (x + 2) * side - 1, texels.x, side, [&](int from) {
      for (int y = 0; y < rows.height(); ++y) rows.at(x, y) = std::min(rows.at(x, y), squares.at(from, y));
    });
  GreenImage all(squares.size(), 255);
  for (int y = 0; y < rows.height(); ++y)
    for_each_square((y - 1) * side, (y + 2) * side - 1, texels.y, side, [&](int from) {
      for (int x = 0; x < rows.width(); ++x) all.at(x, y) = std::min(all.at(x, y), rows.at(x, from));
    });
  std::vector<float> least;
  for (const std::uint8_t byte : all.pixels()) least.push_back(as_float(byte) / 255.0f);
  return least;
}

}  // namespace

void find_least_green(Texture& texture) {
  const glm::ivec2 size = texture.texels.size();
  if (std::min(size.x, size.y) < 64) return;
  GreenImage green(size);
  for (std::size_t i = 0; i < green.pixels().size(); ++i) green[i] = texture.texels[i].g;
  for (std::size_t k = 0; k < texture.least_green.size(); ++k) {
    const int side = Texture::side_of_square(k);
    texture.least_green[k] = with_neighbours(least_of_squares(green, side), size, side);
  }
}

}  // namespace pinocchio
