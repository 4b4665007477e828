#include "core/scene/mip_levels.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/large_memory.h"
#include "core/image/tonemap.h"
#include "core/parallel/workers.h"
#include "core/scene/least_green.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Level = Image<glm::vec4>;

// The value of a texel's bytes.
struct TexelDecoder {
  explicit TexelDecoder(bool is_color) {
    for (std::size_t i = 0; i < 256; ++i) {
      alpha[i] = i / 255.0f;
      color[i] = is_color ? srgb8_to_linear(static_cast<std::uint8_t>(i)) : alpha[i];
    }
  }
  [[nodiscard]] glm::vec4 operator()(const glm::u8vec4& t) const {
    return {color[t.r], color[t.g], color[t.b], alpha[t.a]};
  }

  std::array<float, 256> color{}, alpha{};
};

void encode(std::span<const glm::vec4> texels, bool is_color, glm::u8vec4* to) {
  if (is_color) return linear_to_srgb8(texels, to);
  for (const glm::vec4& t : texels) *to++ = glm::u8vec4(t * 255.0f + 0.5f);
}

bool is_even(const glm::ivec2& size) {
  return size.x % 2 == 0 && size.y % 2 == 0;
}

// The same numbers as half_as_wide() gives along both axes, for even sides.
glm::vec4 mean_of_four(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c, const glm::vec4& d) {
  const auto mean = [](const glm::vec4& x, const glm::vec4& y) { return 0.5f * x + 0.5f * y; };
  return mean(mean(a, b), mean(c, d));
}

// Half as wide: each pixel is the mean of the stretch that it covers, also for odd widths.
Level half_as_wide(const Level& from) {
  const int width = std::max(from.width() / 2, 1);
  const float stretch = from.width() / as_float(width);
  Level to({width, from.height()});
  for (int x = 0; x < width; ++x) {
    const float begin = stretch * x, end = begin + stretch;
    for (int k = as_int(begin); k < from.width() && k < end; ++k) {
      const auto left = as_float(k);
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
  if (!is_even(from.size())) return turned(half_as_wide(turned(half_as_wide(from))));
  Level to(from.size() / 2);
  for (int y = 0; y < to.height(); ++y)
    for (int x = 0; x < to.width(); ++x)
      to.at(x, y) = mean_of_four(from.at(2 * x, 2 * y), from.at(2 * x + 1, 2 * y), from.at(2 * x, 2 * y + 1),
                                 from.at(2 * x + 1, 2 * y + 1));
  return to;
}

// The levels down to one texel a block are made block by block: a block stays in the cache.
constexpr int kMostHalvings = 5;

// How often both sides can be halved without a remainder, at most `most` times.
int halvings_of(const glm::ivec2& size) {
  const auto both = static_cast<unsigned>(size.x | size.y);
  return std::min(std::countr_zero(both), kMostHalvings);
}

// Makes a texture's smaller levels, largest first, row by row.
class LevelWriter {
 public:
  LevelWriter(const Image<glm::u8vec4>& texels, bool is_color)
      : texels_(texels), is_color_(is_color), decode_(is_color) {
    reserve_large(levels_, texels.pixels().size() / 3 + 1);
  }

  // Makes the first `halvings` levels; returns the values of the last.
  Level write_blocks(int halvings) {
    const int side = 1 << halvings;
    std::size_t at = 0;
    for (int k = 1; k <= halvings; ++k) {
      const glm::ivec2 size = texels_.size() / (1 << k);
      first_[k] = at;
      at += size.x * as_size(size.y);
    }
    levels_.resize(at);
    Level last(texels_.size() / side);
    for (int y = 0; y < last.height(); ++y)
      for (int x = 0; x < last.width(); ++x) last.at(x, y) = write_block({x, y}, halvings);
    return last;
  }

  void append(const Level& level) {
    levels_.resize(levels_.size() + level.pixels().size());
    encode(level.pixels(), is_color_, &levels_[levels_.size() - level.pixels().size()]);
  }

  [[nodiscard]] Level whole() const {
    Level level(texels_.size());
    for (std::size_t i = 0; i < level.pixels().size(); ++i) level[i] = decode_(texels_[i]);
    return level;
  }

  [[nodiscard]] std::span<const glm::u8vec4> levels() const { return levels_; }

 private:
  glm::vec4 write_block(const glm::ivec2& block, int halvings) {
    int side = 1 << halvings;
    for (int y = 0; y < side; ++y) {
      const glm::u8vec4* const row = &texels_.at(block.x * side, block.y * side + y);
      for (int x = 0; x < side; ++x) values_[y * side + x] = decode_(row[x]);
    }
    for (int k = 1; k <= halvings; ++k) {
      side /= 2;
      const int width = texels_.width() >> k;
      for (int y = 0; y < side; ++y) {
        glm::u8vec4* const to = &levels_[first_[k] + as_size((block.y * side + y) * width + block.x * side)];
        const glm::vec4* const from = &values_[4 * y * side];
        glm::vec4* const means = &values_[y * side];
        for (int x = 0; x < side; ++x)  // in place: reads are ahead of writes
          means[x] =
              mean_of_four(from[2 * x], from[2 * x + 1], from[2 * side + 2 * x], from[2 * side + 2 * x + 1]);
        encode({means, as_size(side)}, is_color_, to);
      }
    }
    return values_[0];
  }

  const Image<glm::u8vec4>& texels_;
  std::vector<glm::u8vec4> levels_;
  bool is_color_;
  TexelDecoder decode_;
  std::array<std::size_t, kMostHalvings + 1> first_{};  // texel of each level
  std::array<glm::vec4, std::size_t{1} << (2 * kMostHalvings)> values_{};
};

// For each texture: whether its smaller levels are used, whether it is colour, and whether it holds
// roughness.
struct Needed {
  bool levels = false, is_color = false, roughness = false;
};

std::vector<Needed> needed_of(const MeshData& mesh) {
  std::vector<Needed> needed(mesh.textures.size());
  for (const MaterialMaps& m : mesh.maps)
    for (const auto& [member, is_color, of_layers] : kMapUses) {
      const TextureUse& use = m.*member;
      if (member == &MaterialMaps::alpha || !use.used() || as_size(use.texture) >= needed.size()) continue;
      Needed& n = needed[use.texture];
      n.levels = true;
      n.is_color = n.is_color || is_color;
      n.roughness = n.roughness || member == &MaterialMaps::metallic_roughness;
    }
  return needed;
}

bool is_finished(const Texture& texture, const Needed& needed) {
  const glm::ivec2 size = texture.size();
  if (size.x == 0 || size.y == 0) return true;
  return texture.in_blocks() && (!needed.levels || texture.levels() > 1 || size == glm::ivec2(1));
}

void finish(Texture& texture, const Needed& needed) {
  if (texture.in_blocks()) texture.texels = texture.image();
  const glm::ivec2 size = texture.texels.size();
  LevelWriter writer(texture.texels, needed.is_color);
  if (needed.levels && size != glm::ivec2(1)) {
    const int halvings = halvings_of(size);
    Level level = halvings > 0 ? writer.write_blocks(halvings) : writer.whole();
    while (level.width() > 1 || level.height() > 1) {
      level = halved(level);
      writer.append(level);
    }
  }
  texture.least = glm::u8vec4(255);
  texture.most = glm::u8vec4(0);
  for (const glm::u8vec4& texel : texture.texels.pixels()) {
    texture.least = glm::min(texture.least, texel);
    texture.most = glm::max(texture.most, texel);
  }
  texture.least_green = {};
  if (needed.roughness) find_least_green(texture);
  texture.blocks = TexelBlocks(texture.texels, writer.levels());
  texture.texels = {};
}

}  // namespace

void finish_textures(MeshData& mesh, Progress* progress) {
  const std::vector<Needed> needed = needed_of(mesh);
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (!is_finished(mesh.textures[i], needed[i])) unfinished.push_back(i);
  if (unfinished.empty()) return;
  begin_phase(progress, "textures", unfinished.size());
  std::vector<Texture>& textures = mesh.textures.edit();
  Workers workers(unfinished.size() > 1 ? 0 : 1);
  workers.for_each(unfinished.size(), [&](std::size_t i) {
    finish(textures[unfinished[i]], needed[unfinished[i]]);
    advance(progress);
  });
}

}  // namespace pinocchio
