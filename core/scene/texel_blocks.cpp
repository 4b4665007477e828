#include <algorithm>
#include <bit>

#include "pinocchio/texture.h"

namespace pinocchio {
namespace {

int levels_down_to_one(glm::ivec2 size) {
  return as_int(std::bit_width(as_uint32(std::max(size.x, size.y))));
}

std::size_t padded(glm::ivec2 size) {
  const glm::ivec2 blocks = (size + TexelBlocks::kSide - 1) / TexelBlocks::kSide;
  return as_size(blocks.x) * as_size(blocks.y) * TexelBlocks::kTexels;
}

}  // namespace

TexelBlocks::TexelBlocks(const Image<glm::u8vec4>& largest, std::span<const glm::u8vec4> smaller)
    : size_(largest.size()), levels_(smaller.empty() ? 1 : levels_down_to_one(largest.size())) {
  texels_.resize(first(levels_));
  const glm::u8vec4* rows = largest.pixels().data();
  for (int l = 0; l < levels_; ++l) {
    set_level(l, rows);
    rows = l == 0 ? smaller.data() : rows + as_size(size(l).x) * as_size(size(l).y);
  }
}

std::size_t TexelBlocks::first(int level) const {
  std::size_t texels = 0;
  for (int l = 0; l < level; ++l) texels += padded(size(l));
  return texels;
}

Image<glm::u8vec4> TexelBlocks::level(int level) const {
  Image<glm::u8vec4> rows(size(level));
  const glm::u8vec4* const from = &texels_[first(level)];
  for (int y = 0; y < rows.height(); ++y)
    for (int x = 0; x < rows.width(); x += kSide)
      std::copy_n(from + place(rows.width(), x, y), std::min(kSide, rows.width() - x), &rows.at(x, y));
  return rows;
}

void TexelBlocks::set_level(int level, const glm::u8vec4* rows) {
  const glm::ivec2 of = size(level);
  glm::u8vec4* const to = &texels_[first(level)];
  for (int y = 0; y < of.y; ++y)
    for (int x = 0; x < of.x; x += kSide)
      std::copy_n(rows + as_size(y) * as_size(of.x) + x, std::min(kSide, of.x - x), to + place(of.x, x, y));
}

}  // namespace pinocchio
