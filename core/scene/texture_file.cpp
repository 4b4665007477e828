#include "core/scene/texture_file.h"

#include <algorithm>
#include <limits>
#include <memory>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace pinocchio {

namespace {

using Pixels = std::unique_ptr<stbi_uc, void (*)(void*)>;

std::optional<Texture> texture_of(const std::string& name, const glm::ivec2& size, const Pixels& pixels) {
  if (!pixels) return std::nullopt;
  Texture texture{name, Image<glm::u8vec4>(size)};
  const auto* first = reinterpret_cast<const glm::u8vec4*>(pixels.get());
  std::copy_n(first, texture.texels.pixels().size(), texture.texels.pixels().begin());
  return texture;
}

}  // namespace

std::optional<Texture> load_texture(const std::filesystem::path& file) {
  glm::ivec2 size(0);
  int channels = 0;
  const Pixels pixels(stbi_load(file.c_str(), &size.x, &size.y, &channels, 4), stbi_image_free);
  return texture_of(file.filename().string(), size, pixels);
}

std::optional<Texture> decode_texture(const std::string& name, std::span<const unsigned char> bytes) {
  if (bytes.empty() || bytes.size() > std::numeric_limits<int>::max()) return std::nullopt;
  glm::ivec2 size(0);
  int channels = 0;
  const Pixels pixels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &size.x, &size.y, &channels, 4),
      stbi_image_free);
  return texture_of(name, size, pixels);
}

}  // namespace pinocchio
