#include "core/scene/texture_file.h"

#include <algorithm>
#include <charconv>
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
    if (starts_with("\xabKTX 20"))
      return error("is KTX2, which is not read; convert it to PNG, JPEG or WebP");
    if (starts_with("#?"))
      return error("is Radiance HDR, which is for environments; convert it to PNG, JPEG or WebP");
    if (starts_with("P5") || starts_with("P6")) return pnm();
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
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
      return error("has no size that can be");
    const std::string what =
        "image '" + name_ + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (!limit_.take(file_, what, width * height, sizeof(glm::u8vec4))) return Unexpected(*limit_.error());
    image_.texture.name = name_;
    image_.texture.texels = Image<glm::u8vec4>(glm::ivec2(width, height));
    return {};
  }

  [[nodiscard]] unsigned char* texels() {
    return reinterpret_cast<unsigned char*>(image_.texture.texels.pixels().data());
  }
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
    if (!context ||
        tjDecompressHeader3(context.get(), bytes_.data(), size, &width, &height, &subsampling, &colors) != 0)
      return error(std::string("is not JPEG that can be read: ") + tjGetErrorStr2(context.get()));
    if (const Expected<void> made =
            make(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
        !made)
      return Unexpected(made.error());
    const bool cmyk = colors == TJCS_CMYK || colors == TJCS_YCCK;
    if (tjDecompress2(context.get(), bytes_.data(), size, texels(), width, 0, height,
                      cmyk ? TJPF_CMYK : TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0) {
      image_.damage = tjGetErrorStr2(context.get());
      if (tjGetErrorCode(context.get()) != TJERR_WARNING)
        return error("is not JPEG that can be read: " + image_.damage);
    }
    if (cmyk)  // Adobe's: the share of paper that is left
      for (glm::u8vec4& p : image_.texture.texels.pixels())
        p = glm::u8vec4(glm::ivec3(p) * static_cast<int>(p.w) / 255, 255);
    return std::move(image_);
  }

  Expected<DecodedImage> webp() {
    int width = 0, height = 0;
    if (WebPGetInfo(bytes_.data(), bytes_.size(), &width, &height) == 0)
      return error("is not WebP that can be read");
    if (const Expected<void> made =
            make(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
        !made)
      return Unexpected(made.error());
    if (WebPDecodeRGBAInto(bytes_.data(), bytes_.size(), texels(), texel_bytes(), 4 * width) == nullptr)
      return error("is not WebP that can be read (damaged, or an animation)");
    return std::move(image_);
  }

  // Netpbm's P5, grey, and P6, RGB: by ourselves, for stb_image overruns those of 16 bits and takes any white
  // for 255.
  Expected<DecodedImage> pnm() {
    std::size_t at = 2;
    const std::uint32_t width = pnm_number(at), height = pnm_number(at), white = pnm_number(at);
    ++at;  // one white-space character
    if (white < 1 || white > 65535) return error("is not PNM that can be read");
    if (const Expected<void> made = make(width, height); !made) return Unexpected(made.error());
    const std::size_t bytes = white > 255 ? 2 : 1, channels = starts_with("P6") ? 3 : 1;
    const auto sample = [&](std::size_t i) -> std::uint8_t {
      const std::size_t begin = at + i * bytes;
      if (begin + bytes > bytes_.size()) return 0;
      const std::uint32_t value = bytes == 1 ? bytes_[begin] : bytes_[begin] * 256u + bytes_[begin + 1];
      return static_cast<std::uint8_t>((std::min(value, white) * 255 + white / 2) / white);
    };
    const std::span<glm::u8vec4> pixels = image_.texture.texels.pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i)
      pixels[i] = channels == 3 ? glm::u8vec4(sample(3 * i), sample(3 * i + 1), sample(3 * i + 2), 255)
                                : glm::u8vec4(glm::u8vec3(sample(i)), 255);
    if (bytes_.size() < at + pixels.size() * channels * bytes) image_.damage = "it is cut off";
    return std::move(image_);
  }

  // The next number of a PNM's header, after white space and comments; 0: there is none.
  [[nodiscard]] std::uint32_t pnm_number(std::size_t& at) const {
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    for (at = text.find_first_not_of(" \t\n\v\f\r", at); at != text.npos && text[at] == '#';
         at = text.find_first_not_of(" \t\n\v\f\r", at))
      at = std::min(text.find('\n', at), text.size());
    at = std::min(at, text.size());
    std::uint32_t number = 0;
    const auto [end, failure] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    at = static_cast<std::size_t>(end - text.data());
    return failure == std::errc() ? number : 0;
  }

  Expected<DecodedImage> other() {
    if (bytes_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      return error("holds more than 2 GiB; convert it to PNG, JPEG or WebP");
    const int size = static_cast<int>(bytes_.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(bytes_.data(), size, &width, &height, &channels) == 0)
      return error("is not of a format that is read; convert it to PNG, JPEG or WebP");
    // A BMP whose first row is its top one says so by a height below zero.
    const auto rows = static_cast<std::uint64_t>(std::abs(std::int64_t{height}));
    if (const Expected<void> made = make(static_cast<std::uint64_t>(width), rows); !made)
      return Unexpected(made.error());
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes_.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!pixels || glm::ivec2(width, height) != image_.texture.texels.size())
      return error(std::string("cannot be decoded: ") +
                   (pixels ? "its size changes" : stbi_failure_reason()));
    std::copy_n(pixels.get(), texel_bytes(), texels());
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

namespace {

Expected<DecodedImage> decode(const EncodedImage& image, Progress* progress, Loading& loading) {
  if (image.bytes) return decode_texture(image.file, image.name, *image.bytes, loading.limit);
  const Expected<FileBytes> bytes = loading.files.read(image.file, progress);
  if (!bytes) return Unexpected(bytes.error());
  return decode_texture(image.file, image.name, bytes->unsigned_bytes(), loading.limit);
}

}  // namespace

Expected<DecodedImage> load_texture(const std::filesystem::path& file, Loading& loading) {
  return decode({file.string(), file.filename().string(), std::nullopt}, loading.progress, loading);
}

std::vector<Expected<DecodedImage>> decode_textures(const std::vector<EncodedImage>& images,
                                                    Loading& loading) {
  std::vector<Expected<DecodedImage>> decoded(images.size(), DecodedImage{});
  if (images.empty()) return decoded;
  begin_phase(loading.progress, "images", static_cast<double>(images.size()));
  Workers workers(images.size() > 1 ? 0 : 1);
  workers.for_each(images.size(), [&](std::size_t i) {
    decoded[i] = decode(images[i], nullptr, loading);
    advance(loading.progress);
  });
  return decoded;
}

}  // namespace pinocchio
