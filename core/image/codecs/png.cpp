#include "core/image/codecs/png.h"

#include <spng.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "core/files/atomic_file.h"
#include "core/image/codecs/decoders.h"
#include "pinocchio/error.h"

namespace pinocchio {
namespace {

using SpngContext = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

constexpr char kKeyword[] = "pinocchio";

std::string encode(glm::ivec2 size, int channels, std::span<const std::byte> pixels,
                   const std::string& text) {
  const SpngContext context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  spng_ihdr header{};
  header.width = size.x;
  header.height = size.y;
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

}  // namespace

std::string encode_png(const Image<glm::u8vec3>& pixels) {
  return encode(pixels.size(), 3, std::as_bytes(pixels.pixels()), {});
}

std::string encode_png(const Image<glm::u8vec4>& pixels) {
  return encode(pixels.size(), 4, std::as_bytes(pixels.pixels()), {});
}

void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels, const std::string& text) {
  check_writable(file);
  write_text(file, encode(pixels.size(), 3, std::as_bytes(pixels.pixels()), text));
}

void write_png(const std::filesystem::path& file, const Image<glm::u8vec4>& pixels, const std::string& text) {
  check_writable(file);
  write_text(file, encode(pixels.size(), 4, std::as_bytes(pixels.pixels()), text));
}

Expected<DecodedImage> decode_png(const EncodedPicture& picture) {
  const SpngContext context(spng_ctx_new(0), spng_ctx_free);
  if (!context) return picture.error("cannot be decoded");
  spng_set_chunk_limits(context.get(), std::size_t{1} << 26, std::size_t{1} << 26);
  int failure = spng_set_png_buffer(context.get(), picture.bytes.data(), picture.bytes.size());
  spng_ihdr header{};
  if (failure == 0) failure = spng_get_ihdr(context.get(), &header);
  if (failure != 0) return picture.error(std::string("cannot be read as PNG: ") + spng_strerror(failure));
  Expected<DecodedImage> image = picture.black(header.width, header.height);
  if (!image) return image;
  // The rows of a file that is cut off are kept, so they are decoded one by one where it is not interlaced.
  const std::span<unsigned char> texels = bytes_of(*image);
  failure = spng_decode_image(context.get(), texels.data(), texels.size(), SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
  if (failure != 0) image->damage = spng_strerror(failure);
  return image;
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
