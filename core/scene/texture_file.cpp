#include "core/scene/texture_file.h"

#include <algorithm>
#include <memory>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace pinocchio {

std::optional<Texture> load_texture(const std::filesystem::path& file) {
  glm::ivec2 size(0);
  int channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(file.c_str(), &size.x, &size.y, &channels, 4), stbi_image_free);
  if (!pixels) return std::nullopt;
  Texture texture{file.filename().string(), Image<glm::u8vec4>(size)};
  const auto* first = reinterpret_cast<const glm::u8vec4*>(pixels.get());
  std::copy_n(first, texture.texels.pixels().size(), texture.texels.pixels().begin());
  return texture;
}

}  // namespace pinocchio
