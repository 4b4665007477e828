#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"
#include "pinocchio/pixel_memory.h"

namespace pinocchio {

// The levels of a texture, largest first, each half as large as the one before and the mean of it. Texels are
// in blocks of 4 x 4, a cache line each, so that those below and above are as near as those beside; a level's
// sides are padded to whole blocks.
class TexelBlocks {
 public:
  static constexpr int kSide = 4, kTexels = kSide * kSide;

  TexelBlocks() = default;
  // smaller: the other levels row by row, one after the other; none: there is one level.
  TexelBlocks(const Image<glm::u8vec4>& largest, std::span<const glm::u8vec4> smaller);

  [[nodiscard]] bool empty() const { return texels_.empty(); }
  [[nodiscard]] int levels() const { return levels_; }
  [[nodiscard]] glm::ivec2 size(int level) const { return glm::max(size_ >> level, glm::ivec2(1)); }
  [[nodiscard]] Image<glm::u8vec4> level(int level) const;
  [[nodiscard]] const glm::u8vec4& at(int level, int x, int y) const {
    return texels_[first(level) + place(size(level).x, x, y)];
  }

  // A level's first texel, and the place of others behind it.
  [[nodiscard]] std::size_t first(int level) const;
  [[nodiscard]] static std::size_t place(int width, int x, int y) {
    return as_size(y / kSide) * as_size((width + kSide - 1) / kSide * kTexels) +
           as_size(x / kSide * kTexels) + as_size(y % kSide * kSide + x % kSide);
  }
  [[nodiscard]] const glm::u8vec4* data() const { return texels_.data(); }

  friend bool operator==(const TexelBlocks&, const TexelBlocks&) = default;

 private:
  void set_level(int level, const glm::u8vec4* rows);

  glm::ivec2 size_{0};
  int levels_ = 0;
  std::vector<glm::u8vec4, PixelAllocator<glm::u8vec4>> texels_;
};

// RGBA, 8 bits for each channel. Colour is sRGB, as the file stores it; alpha and other data are linear. Row
// 0 is the top row.
struct Texture {
  std::string name;
  Image<glm::u8vec4> texels;        // for a new mesh, which moves them to `blocks`; none in a finished one
  TexelBlocks blocks{};             // with levels down to one texel where the texture is interpolated
  glm::u8vec4 least{0}, most{255};  // of all texels, each channel by itself; a finished mesh has them
  // A finished mesh's textures of roughness have a word for each square of kGreenSide texels a side, row by
  // row. Its byte k is the least green of the square and of the texels up to kGreenSide << k around it;
  // beyond an edge the texture repeats.
  std::vector<std::uint32_t> least_green{};
  static constexpr int kGreenSide = 4, kGreenReaches = 4;

  [[nodiscard]] bool in_blocks() const { return texels.empty() && !blocks.empty(); }
  [[nodiscard]] glm::ivec2 size() const { return in_blocks() ? blocks.size(0) : texels.size(); }
  [[nodiscard]] int levels() const { return std::max(blocks.levels(), 1); }
  [[nodiscard]] Image<glm::u8vec4> image() const { return in_blocks() ? blocks.level(0) : texels; }
};

// A mesh's textures. Copies share them until one is edited, so that meshes with different vertices hold them
// once.
class Textures {
 public:
  Textures() = default;
  Textures(std::initializer_list<Texture> textures)
      : all_(std::make_shared<std::vector<Texture>>(textures)) {}

  [[nodiscard]] std::size_t size() const { return all_ ? all_->size() : 0; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const Texture& operator[](std::size_t i) const { return (*all_)[i]; }
  [[nodiscard]] const Texture* begin() const { return all_ ? all_->data() : nullptr; }
  [[nodiscard]] const Texture* end() const { return begin() + size(); }

  // For changes. Copies keep the old textures.
  [[nodiscard]] std::vector<Texture>& edit() {
    if (!all_ || all_.use_count() > 1) all_ = std::make_shared<std::vector<Texture>>(begin(), end());
    return *all_;
  }
  // Whether both share the same textures, not only equal ones.
  [[nodiscard]] bool shares_with(const Textures& other) const { return all_ == other.all_; }

 private:
  std::shared_ptr<std::vector<Texture>> all_;  // null: none
};

// How a texture continues beyond its edges.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

// How a surface uses a texture.
struct TextureUse {
  int texture = -1;  // index in MeshData::textures; -1: none, like white
  int uv_set = 0;    // 0: MeshData::texcoords, 1: MeshData::texcoords1
  glm::mat3x2 uv_from_texcoord{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};  // KHR_texture_transform, MTL's -s and -o
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  // false: interpolated

  [[nodiscard]] bool used() const { return texture >= 0; }
  friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

}  // namespace pinocchio
