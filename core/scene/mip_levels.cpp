#include "core/scene/mip_levels.h"

#include <algorithm>
#include <array>

#include "core/image/tonemap.h"
#include "core/parallel/workers.h"

namespace pinocchio {
namespace {

using Level = Image<glm::vec4>;

// What a texel's bytes stand for.
struct TexelDecoder {
  explicit TexelDecoder(bool is_color) {
    for (std::size_t i = 0; i < 256; ++i) {
      alpha[i] = static_cast<float>(i) / 255.0f;
      color[i] = is_color ? srgb8_to_linear(static_cast<std::uint8_t>(i)) : alpha[i];
    }
  }
  [[nodiscard]] glm::vec4 operator()(const glm::u8vec4& t) const {
    return {color[t.r], color[t.g], color[t.b], alpha[t.a]};
  }

  std::array<float, 256> color{}, alpha{};
};

glm::u8vec4 encoded(const glm::vec4& t, bool is_color) {
  const glm::u8vec4 raw(t * 255.0f + 0.5f);
  if (!is_color) return raw;
  return {linear_to_srgb8(t.r), linear_to_srgb8(t.g), linear_to_srgb8(t.b), raw.a};
}

bool is_even(const glm::ivec2& size) {
  return size.x % 2 == 0 && size.y % 2 == 0;
}

// Half as wide and high where both are even: the same numbers as the general way below gives, in one pass.
template <class T, class Decode>
Level halved(const Image<T>& from, const Decode& decode) {
  Level to(from.size() / 2);
  const auto mean = [](const glm::vec4& a, const glm::vec4& b) { return 0.5f * a + 0.5f * b; };
  for (int y = 0; y < to.height(); ++y)
    for (int x = 0; x < to.width(); ++x)
      to.at(x, y) = mean(mean(decode(from.at(2 * x, 2 * y)), decode(from.at(2 * x + 1, 2 * y))),
                         mean(decode(from.at(2 * x, 2 * y + 1)), decode(from.at(2 * x + 1, 2 * y + 1))));
  return to;
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

Level halved(const Level& from) {
  if (is_even(from.size())) return halved(from, [](const glm::vec4& t) { return t; });
  return turned(half_as_wide(turned(half_as_wide(from))));
}

Level first_level(const Image<glm::u8vec4>& texels, const TexelDecoder& decode) {
  if (is_even(texels.size())) return halved(texels, decode);
  Level whole(texels.size());
  for (std::size_t i = 0; i < whole.pixels().size(); ++i) whole[i] = decode(texels[i]);
  return halved(whole);
}

// Of each texture: whether its smaller levels are looked up, and whether it is colour.
struct Needed {
  bool levels = false, is_color = false;
};

std::vector<Needed> needed_of(const MeshData& mesh) {
  std::vector<Needed> needed(mesh.textures.size());
  for (const MaterialMaps& m : mesh.maps)
    for (const TextureUse* use : m.uses())
      if (use != &m.alpha && use->used() && static_cast<std::size_t>(use->texture) < needed.size()) {
        Needed& n = needed[static_cast<std::size_t>(use->texture)];
        n.levels = true;
        n.is_color = n.is_color || use == &m.base_color || use == &m.emissive || use == &m.specular_color;
      }
  return needed;
}

}  // namespace

void make_smaller_levels(Texture& texture, bool is_color) {
  texture.smaller_levels.clear();
  texture.smaller_levels.reserve(texture.texels.pixels().size() / 3 + 1);
  if (texture.texels.width() <= 1 && texture.texels.height() <= 1) return;
  Level level = first_level(texture.texels, TexelDecoder(is_color));
  while (true) {
    for (const glm::vec4& t : level.pixels()) texture.smaller_levels.push_back(encoded(t, is_color));
    if (level.width() <= 1 && level.height() <= 1) return;
    level = halved(level);
  }
}

void make_smaller_levels(MeshData& mesh, Progress* progress) {
  const std::vector<Needed> needed = needed_of(mesh);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (needed[i].levels && mesh.textures[i].smaller_levels.empty() &&
        mesh.textures[i].texels.pixels().size() > 1)
      missing.push_back(i);
  if (missing.empty()) return;
  begin_phase(progress, "textures", static_cast<double>(missing.size()));
  std::vector<Texture>& textures = mesh.textures.edit();
  Workers workers(missing.size() > 1 ? 0 : 1);
  workers.for_each(missing.size(), [&](std::size_t i) {
    make_smaller_levels(textures[missing[i]], needed[missing[i]].is_color);
    advance(progress);
  });
}

}  // namespace pinocchio
