#include "core/image/png.h"

#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "core/image/atomic_file.h"
#include "pinocchio/error.h"

namespace pinocchio {
namespace {

using SpngContext = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

constexpr char kKeyword[] = "pinocchio";

}  // namespace

Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev, ToneMap curve) {
  const float gain = std::exp2(exposure_ev);
  Image<glm::u8vec3> pixels(color.size());
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const glm::vec3 shown = tone_mapped(gain * glm::vec3(color[i]), curve);
    for (int c = 0; c < 3; ++c) pixels[i][c] = linear_to_srgb8(shown[c]);
  }
  return pixels;
}

std::string encode_png(glm::ivec2 size, int channels, std::span<const std::byte> pixels,
                       const std::string& text) {
  const SpngContext context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(size.x);
  header.height = static_cast<std::uint32_t>(size.y);
  header.bit_depth = 8;
  header.color_type = channels == 4 ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
  int failure = context ? spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1) : SPNG_EMEM;
  if (failure == 0) failure = spng_set_ihdr(context.get(), &header);
  std::string copy = text;
  spng_text chunk{};
  std::ranges::copy(kKeyword, chunk.keyword);
  chunk.type = SPNG_TEXT;
  chunk.text = copy.data();
  chunk.length = copy.size();
  if (failure == 0 && !text.empty()) failure = spng_set_text(context.get(), &chunk, 1);
  if (failure == 0)
    failure =
        spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::size_t bytes = 0;
  void* const png = failure == 0 ? spng_get_png_buffer(context.get(), &bytes, &failure) : nullptr;
  const std::unique_ptr<void, void (*)(void*)> owner(png, std::free);
  if (!png)
    throw EnvironmentError(std::string("a picture cannot be encoded as PNG: ") + spng_strerror(failure));
  return {static_cast<const char*>(png), bytes};
}

void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels, const std::string& text) {
  check_writable(file);
  write_text(file, encode_png(pixels.size(), 3, std::as_bytes(pixels.pixels()), text));
}

std::optional<std::string> text_of_png(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), std::fclose);
  const SpngContext context(spng_ctx_new(0), spng_ctx_free);
  std::size_t size = 0;
  if (!in || !context || spng_set_png_file(context.get(), in.get()) != 0 ||
      spng_decoded_image_size(context.get(), SPNG_FMT_PNG, &size) != 0)
    return std::nullopt;
  std::vector<std::byte> pixels(size);
  if (spng_decode_image(context.get(), pixels.data(), size, SPNG_FMT_PNG, 0) != 0) return std::nullopt;
  std::uint32_t count = 0;
  if (spng_get_text(context.get(), nullptr, &count) != 0) return std::nullopt;
  std::vector<spng_text> texts(count);
  if (spng_get_text(context.get(), texts.data(), &count) != 0) return std::nullopt;
  for (const spng_text& text : texts)
    if (std::strcmp(text.keyword, kKeyword) == 0) return std::string(text.text, text.length);
  return std::nullopt;
}

}  // namespace pinocchio
