#include "core/image/codecs/formats.h"

#include <algorithm>
#include <limits>

#include "core/files/input_file.h"
#include "core/image/codecs/decoders.h"
#include "core/image/tonemap.h"
#include "pinocchio/load.h"

namespace pinocchio {
namespace {

using Bytes = std::span<const unsigned char>;

bool is_webp(Bytes bytes) {
  return starts_with(bytes, "RIFF") && bytes.size() > 8 && starts_with(bytes.subspan(8), "WEBP");
}

// The last row is the one that tries to read.
constexpr PictureFormat kFormats[] = {
    {.name = "PNG",
     .extensions = ".png",
     .matches = [](Bytes bytes) { return starts_with(bytes, "\x89PNG"); },
     .decode_texels = decode_png,
     .written = true},
    {.name = "JPEG",
     .extensions = ".jpg .jpeg",
     .matches = [](Bytes bytes) { return starts_with(bytes, "\xff\xd8\xff"); },
     .decode_texels = decode_jpeg},
    {.name = "WebP", .extensions = ".webp", .matches = is_webp, .decode_texels = decode_webp},
    {.name = "PNM",
     .extensions = ".pgm .ppm .pnm",
     .matches = [](Bytes bytes) { return starts_with(bytes, "P5") || starts_with(bytes, "P6"); },
     .decode_texels = decode_pnm},
    {.name = "EXR",
     .extensions = ".exr",
     .matches = [](Bytes bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); },
     .decode_light = decode_exr_light,
     .written = true},
    {.name = "Radiance HDR",
     .extensions = ".hdr",
     .matches = [](Bytes bytes) { return starts_with(bytes, "#?"); },
     .decode_light = decode_radiance},
    {.name = "KTX2",
     .extensions = ".ktx2",
     .matches = [](Bytes bytes) { return starts_with(bytes, "\xabKTX 20"); }},
    {.name = "DDS", .extensions = ".dds", .matches = [](Bytes bytes) { return starts_with(bytes, "DDS "); }},
    {.name = "BMP",
     .extensions = ".bmp",
     .matches = [](Bytes bytes) { return starts_with(bytes, "BM"); },
     .decode_texels = decode_stb},
    {.name = "GIF",
     .extensions = ".gif",
     .matches = [](Bytes bytes) { return starts_with(bytes, "GIF8"); },
     .decode_texels = decode_stb},
    {.name = "TGA", .extensions = ".tga", .matches = is_stb, .decode_texels = decode_tga}};

Expected<DecodedImage> read_texels(const std::filesystem::path& file) {
  const std::string path = file.string();
  const Expected<FileBytes> bytes = read_input_file(file, nullptr);
  if (!bytes) return Unexpected(bytes.error());
  MemoryLimit limit(kUsualLoadLimit);
  Expected<DecodedImage> image =
      decode_texture({path, file.filename().string(), bytes->unsigned_bytes(), limit});
  if (image && !image->damage.empty())
    return Unexpected(InputError{path, 0, "is damaged: " + image->damage, "write it again"});
  return image;
}

}  // namespace

std::span<const PictureFormat> picture_formats() {
  return kFormats;
}

const PictureFormat* format_of(std::span<const unsigned char> bytes) {
  const auto* const row = std::ranges::find_if(kFormats, [&](const auto& f) { return f.matches(bytes); });
  return row == std::end(kFormats) ? nullptr : row;
}

const PictureFormat* format_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string() + " ";
  for (const PictureFormat& format : kFormats)
    if (extension.size() > 1 && (std::string(format.extensions) + " ").find(extension) != std::string::npos)
      return &format;
  return nullptr;
}

Expected<DecodedImage> decode_texture(const EncodedPicture& picture) {
  if (picture.bytes.empty()) return picture.error("is empty");
  if (picture.bytes.size() > std::numeric_limits<int>::max()) return picture.error("is larger than 2 GiB");
  const std::string remedy = "; convert it to PNG, JPEG or WebP";
  const PictureFormat* const format = format_of(picture.bytes);
  if (!format) return picture.error("is not of a format that is read" + remedy);
  if (format->decode_texels) return format->decode_texels(picture);
  return picture.error("is " + std::string(format->name) +
                       (format->decode_light ? ", which is for environments" : ", which is not read") +
                       remedy);
}

Expected<ExrFile> read_picture(const std::filesystem::path& file) {
  const PictureFormat* const format = format_of(file);
  if (!format || !format->written || !format->decode_texels) return read_exr(file);
  const Expected<DecodedImage> image = read_texels(file);
  if (!image) return Unexpected(image.error());
  const Image<glm::u8vec4>& texels = image->texture.texels;
  ExrFile picture;
  picture.display_size = texels.size();
  picture.data_window = {{0, 0}, texels.size()};
  for (int c = 0; c < 3; ++c) {
    ExrChannel& channel = picture.channels.emplace_back();
    channel.name = "RGB"[c];
    channel.type = ExrChannel::Type::real;
    for (const glm::u8vec4& texel : texels.pixels()) channel.values.push_back(srgb8_to_linear(texel[c]));
  }
  return picture;
}

}  // namespace pinocchio
