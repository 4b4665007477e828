#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"

namespace pinocchio {

// RGBA, 8 bits for each channel. Colour is sRGB, as the file stores it; alpha and other data are linear. Row
// 0 is the top row.
struct Texture {
  std::string name;
  Image<glm::u8vec4> texels;
  // Mipmap levels from half the size down to one texel, each the mean of the previous. A finished mesh has
  // them for the textures that are interpolated.
  std::vector<glm::u8vec4> smaller_levels{};

  [[nodiscard]] int levels() const {
    if (smaller_levels.empty()) return 1;
    return as_int(std::bit_width(static_cast<unsigned>(std::max(texels.width(), texels.height()))));
  }
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
