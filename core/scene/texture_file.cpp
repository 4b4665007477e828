#include "core/scene/texture_file.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>

#include <spng.h>
#include <turbojpeg.h>
#include <webp/decode.h>
#define STB_IMAGE_STATIC
// What a file that is cut off does not hold is black, the same every time.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(old, size) std::realloc(old, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_HDR
#define STBI_ONLY_PNM
#define STBI_ONLY_TGA
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "core/parallel/workers.h"
#include "core/scene/input_file.h"

namespace pinocchio {
namespace {

using Bytes = std::span<const unsigned char>;

class Decoder {
 public:
  Decoder(const std::string& file, const std::string& name, Bytes bytes, MemoryLimit& limit)
      : file_(file), name_(name), bytes_(bytes), limit_(limit) {}

  Expected<DecodedImage> decode() {
    if (bytes_.empty()) return error("is empty");
    if (bytes_.size() > std::numeric_limits<int>::max()) return error("is larger than 2 GiB");
    if (starts_with("\x89PNG")) return png();
    if (starts_with("\xff\xd8\xff")) return jpeg();
    if (starts_with("RIFF") && starts_with("WEBP", 8)) return webp();
    if (starts_with("\xabKTX 20")) return error("is KTX2, which is not read; convert it to PNG, JPEG or WebP");
    if (starts_with("#?")) return error("is Radiance HDR, which is for environments; convert it to PNG, JPEG or WebP");
    if (starts_with("DDS ")) return error("is DDS, which is not read; convert it to PNG, JPEG or WebP");
    return other();
  }

 private:
  [[nodiscard]] bool starts_with(std::string_view magic, std::size_t at = 0) const {
    return bytes_.size() >= at + magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
  }

  [[nodiscard]] Unexpected error(const std::string& what) const {
    return Unexpected(InputError{file_, 0, "image '" + name_ + "' " + what, ""});
  }

  // Memory for the pixels that a header promises, if they are within the limit.
  Expected<void> make(std::uint64_t width, std::uint64_t height) {
    constexpr std::uint64_t kMostSide = 1 << 20;
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide) return error("has no size that can be");
    const std::string what = "image '" + name_ + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (!limit_.take(file_, what, width * height, sizeof(glm::u8vec4))) return Unexpected(*limit_.error());
    image_.texture.name = name_;
    image_.texture.texels = Image<glm::u8vec4>(glm::ivec2(width, height));
    return {};
  }

  [[nodiscard]] unsigned char* texels() { return reinterpret_cast<unsigned char*>(image_.texture.texels.pixels().data()); }
  [[nodiscard]] std::size_t texel_bytes() const { return image_.texture.texels.pixels().size_bytes(); }

  Expected<DecodedImage> png() {
    const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
    if (!context) return error("cannot be decoded");
    spng_set_chunk_limits(context.get(), std::size_t{1} << 26, std::size_t{1} << 26);
    int failure = spng_set_png_buffer(context.get(), bytes_.data(), bytes_.size());
    spng_ihdr header{};
    if (failure == 0) failure = spng_get_ihdr(context.get(), &header);
    if (failure != 0) return error(std::string("is not PNG that can be read: ") + spng_strerror(failure));
    if (const Expected<void> made = make(header.width, header.height); !made) return Unexpected(made.error());
    // What is there of a file that is cut off is kept, so row by row where it is not interlaced.
    failure = spng_decode_image(context.get(), texels(), texel_bytes(), SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
    if (failure != 0) image_.damage = spng_strerror(failure);
    return std::move(image_);
  }

  Expected<DecodedImage> jpeg() {
    const std::unique_ptr<void, int (*)(tjhandle)> context(tjInitDecompress(), tjDestroy);
    const auto size = static_cast<unsigned long>(bytes_.size());
    int width = 0, height = 0, subsampling = 0, colors = 0;
    if (!context || tjDecompressHeader3(context.get(), bytes_.data(), size, &width, &height, &subsampling, &colors) != 0)
      return error(std::string("is not JPEG that can be read: ") + tjGetErrorStr2(context.get()));
    if (const Expected<void> made = make(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)); !made)
      return Unexpected(made.error());
    const bool cmyk = colors == TJCS_CMYK || colors == TJCS_YCCK;
    if (tjDecompress2(context.get(), bytes_.data(), size, texels(), width, 0, height, cmyk ? TJPF_CMYK : TJPF_RGBA,
                      TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0) {
      image_.damage = tjGetErrorStr2(context.get());
      if (tjGetErrorCode(context.get()) != TJERR_WARNING) return error("is not JPEG that can be read: " + image_.damage);
    }
    if (cmyk)  // Adobe's: the share of paper that is left
      for (glm::u8vec4& p : image_.texture.texels.pixels())
        p = glm::u8vec4(glm::ivec3(p) * static_cast<int>(p.w) / 255, 255);
    return std::move(image_);
  }

  Expected<DecodedImage> webp() {
    int width = 0, height = 0;
    if (WebPGetInfo(bytes_.data(), bytes_.size(), &width, &height) == 0) return error("is not WebP that can be read");
    if (const Expected<void> made = make(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)); !made)
      return Unexpected(made.error());
    if (WebPDecodeRGBAInto(bytes_.data(), bytes_.size(), texels(), texel_bytes(), 4 * width) == nullptr)
      return error("is not WebP that can be read (damaged, or an animation)");
    return std::move(image_);
  }

  Expected<DecodedImage> other() {
    const int size = static_cast<int>(bytes_.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(bytes_.data(), size, &width, &height, &channels) == 0)
      return error("is not of a format that is read; convert it to PNG, JPEG or WebP");
    if (const Expected<void> made = make(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)); !made)
      return Unexpected(made.error());
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes_.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!pixels || glm::ivec2(width, height) != image_.texture.texels.size())
      return error(std::string("cannot be decoded: ") + (pixels ? "its size changes" : stbi_failure_reason()));
    std::copy_n(pixels.get(), texel_bytes(), texels());
    const bool netpbm = starts_with("P5") || starts_with("P6");  // whose reader does not look where the file ends
    if (netpbm && bytes_.size() < texel_bytes() / 4 * static_cast<std::size_t>(channels)) image_.damage = "it is cut off";
    return std::move(image_);
  }

  const std::string &file_, &name_;
  Bytes bytes_;
  MemoryLimit& limit_;
  DecodedImage image_;
};

}  // namespace

Expected<DecodedImage> decode_texture(const std::string& file, const std::string& name,
                                      std::span<const unsigned char> bytes, MemoryLimit& limit) {
  return Decoder(file, name, bytes, limit).decode();
}

Expected<Image<glm::vec3>> decode_radiance(const std::string& file, std::span<const unsigned char> bytes,
                                           MemoryLimit& limit) {
  const auto fail = [&file](const std::string& what) {
    return Unexpected(InputError{file, 0, "is not Radiance that can be read: " + what, "is it damaged?"});
  };
  if (bytes.size() > std::numeric_limits<int>::max()) return fail("it is larger than 2 GiB");
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) return fail(stbi_failure_reason());
  if (width < 1 || height < 1) return fail("it has no size that can be");
  // As it is decoded, the copy, and an environment's sums.
  if (!limit.take(file, "the environment", static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height),
                  2 * sizeof(glm::vec3) + sizeof(float)))
    return Unexpected(*limit.error());
  const std::unique_ptr<float, void (*)(void*)> pixels(
      stbi_loadf_from_memory(bytes.data(), size, &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) return fail(stbi_failure_reason());
  Image<glm::vec3> image(glm::ivec2(width, height));
  for (std::size_t i = 0; i < image.pixels().size(); ++i)
    image[i] = {pixels.get()[3 * i], pixels.get()[3 * i + 1], pixels.get()[3 * i + 2]};
  return image;
}

namespace {

Expected<DecodedImage> decode(const EncodedImage& image, Progress* progress, MemoryLimit& limit) {
  if (image.bytes) return decode_texture(image.file, image.name, *image.bytes, limit);
  const Expected<std::string> bytes = read_input_file(image.file, progress);
  if (!bytes) return Unexpected(bytes.error());
  return decode_texture(image.file, image.name, {reinterpret_cast<const unsigned char*>(bytes->data()), bytes->size()}, limit);
}

}  // namespace

Expected<DecodedImage> load_texture(const std::filesystem::path& file, Loading& loading) {
  return decode({file.string(), file.filename().string(), std::nullopt}, loading.progress, loading.limit);
}

std::vector<Expected<DecodedImage>> decode_textures(const std::vector<EncodedImage>& images, Loading& loading) {
  std::vector<Expected<DecodedImage>> decoded(images.size(), DecodedImage{});
  if (images.empty()) return decoded;
  begin_phase(loading.progress, "images", static_cast<double>(images.size()));
  Workers workers(images.size() > 1 ? 0 : 1);
  workers.for_each(images.size(), [&](std::size_t i) {
    decoded[i] = decode(images[i], nullptr, loading.limit);
    advance(loading.progress);
  });
  return decoded;
}

std::string png_of(const Texture& texture) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  const glm::ivec2 size = texture.texels.size();
  spng_ihdr header{static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y), 8, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 0, 0, 0};
  std::size_t bytes = 0;
  int failure = context ? spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1) : SPNG_EMEM;
  if (failure == 0) failure = spng_set_ihdr(context.get(), &header);
  if (failure == 0)
    failure = spng_encode_image(context.get(), texture.texels.pixels().data(), texture.texels.pixels().size_bytes(),
                                SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  void* const png = failure == 0 ? spng_get_png_buffer(context.get(), &bytes, &failure) : nullptr;
  const std::unique_ptr<void, void (*)(void*)> owner(png, std::free);
  if (!png) throw EnvironmentError("image '" + texture.name + "' cannot be encoded: " + spng_strerror(failure));
  return {static_cast<const char*>(png), bytes};
}

}  // namespace pinocchio
