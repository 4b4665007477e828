#include "core/image/png.h"

#include <cmath>
#include <cstdint>
#include <fstream>

#include "core/image/atomic_file.h"
#include "pinocchio/error.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace pinocchio {

Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev, ToneMap curve) {
  const float gain = std::exp2(exposure_ev);
  Image<glm::u8vec3> pixels(color.size());
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const glm::vec3 shown = tone_mapped(gain * glm::vec3(color[i]), curve);
    for (int c = 0; c < 3; ++c) pixels[i][c] = linear_to_srgb8(shown[c]);
  }
  return pixels;
}

void check_png_size(const std::filesystem::path& file, glm::ivec2 size) {
  constexpr std::int64_t kMost = std::int64_t{1} << 30;  // the encoder doubles its int as it grows
  if ((std::int64_t{3} * size.x + 1) * size.y > kMost)
    throw EnvironmentError(file.string() + ": " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                           " pixels are more than a PNG is written of; write an EXR, or a smaller picture");
}

void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels) {
  check_png_size(file, pixels.size());
  check_writable(file);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    const auto put = [](void* to, void* data, int bytes) {
      static_cast<std::ofstream*>(to)->write(static_cast<const char*>(data), bytes);
    };
    const int encoded =
        stbi_write_png_to_func(put, &out, pixels.width(), pixels.height(), 3, pixels.pixels().data(), 0);
    if (!encoded || !out.flush())
      throw EnvironmentError(file.string() + ": cannot be written; is the disk full?");
  });
}

}  // namespace pinocchio
