#include "core/scene/mip_levels.h"

#include "core/image/tonemap.h"

namespace pinocchio {
namespace {

using Level = Image<glm::vec4>;

glm::vec4 decoded(const glm::u8vec4& t, bool is_color) {
  const glm::vec4 raw = glm::vec4(t) / 255.0f;
  if (!is_color) return raw;
  return {srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b), raw.a};
}

glm::u8vec4 encoded(const glm::vec4& t, bool is_color) {
  const glm::u8vec4 raw(t * 255.0f + 0.5f);
  if (!is_color) return raw;
  return {linear_to_srgb8(t.r), linear_to_srgb8(t.g), linear_to_srgb8(t.b), raw.a};
}

// Half as wide: each pixel the mean of the stretch that it stands for, also where the width is odd.
Level half_as_wide(const Level& from) {
  const int width = std::max(from.width() / 2, 1);
  const float stretch = static_cast<float>(from.width()) / static_cast<float>(width);
  Level to({width, from.height()});
  for (int x = 0; x < width; ++x) {
    const float begin = stretch * static_cast<float>(x), end = begin + stretch;
    for (int k = static_cast<int>(begin); k < from.width() && static_cast<float>(k) < end; ++k) {
      const auto left = static_cast<float>(k);
      const float share = (std::min(end, left + 1.0f) - std::max(begin, left)) / stretch;
      for (int y = 0; y < to.height(); ++y) to.at(x, y) += share * from.at(k, y);
    }
  }
  return to;
}

Level turned(const Level& from) {
  Level to({from.height(), from.width()});
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x) to.at(y, x) = from.at(x, y);
  return to;
}

}  // namespace

void make_smaller_levels(Texture& texture, bool is_color) {
  texture.smaller_levels.clear();
  Level level(texture.texels.size());
  for (std::size_t i = 0; i < level.pixels().size(); ++i) level[i] = decoded(texture.texels[i], is_color);
  while (level.width() > 1 || level.height() > 1) {
    level = turned(half_as_wide(turned(half_as_wide(level))));
    for (const glm::vec4& t : level.pixels()) texture.smaller_levels.push_back(encoded(t, is_color));
  }
}

}  // namespace pinocchio
