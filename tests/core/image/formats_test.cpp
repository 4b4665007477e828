// Walks the table of picture formats: a sample of each, of one pixel.
#include "core/image/codecs/formats.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "core/image/codecs/png.h"
#include "pinocchio/environment.h"
#include "pinocchio/load.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

constexpr glm::u8vec4 kColor(200, 100, 50, 255);
constexpr int kTolerance = 4;  // JPEG's

std::string jpeg() {
  const std::unique_ptr<void, int (*)(tjhandle)> context(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(context.get(), &kColor.x, 1, 0, 1, TJPF_RGBA, &bytes, &size, TJSAMP_444, 95,
                        TJFLAG_ACCURATEDCT),
            0);
  const std::string jpeg(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  return jpeg;
}

std::string webp() {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(&kColor.x, 1, 1, 4, &bytes);
  const std::string webp(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return webp;
}

// As light, the colour's bytes are 256ths.
std::string exr() {
  ExrFile file;
  file.display_size = {1, 1};
  file.data_window = {{0, 0}, {1, 1}};
  for (int c = 0; c < 3; ++c)
    file.channels.push_back({std::string(1, "RGB"[c]), ExrChannel::Type::real, {kColor[c] / 256.0f}, {}});
  write_exr(own_file("sample.exr"), file);
  std::ostringstream bytes;
  bytes << std::ifstream(own_file("sample.exr"), std::ios::binary).rdbuf();
  return bytes.str();
}

std::map<std::string_view, std::string> samples() {
  const std::string rgb("\xc8\x64\x32"), bgr("\x32\x64\xc8");
  return {
      {"PNG", encode_png(Image<glm::u8vec4>({1, 1}, kColor))},
      {"JPEG", jpeg()},
      {"WebP", webp()},
      {"PNM", "P6 1 1 255\n" + rgb},
      {"EXR", exr()},
      {"Radiance HDR", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + rgb + "\x80"},
      {"KTX2", std::string("\xabKTX 20\xbb\r\n\x1a\n", 12)},
      {"DDS", "DDS |"},
      {"BMP", std::string("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0", 30) +
                  std::string(24, '\0') + bgr + '\0'},
      {"GIF", std::string("GIF89a\x01\0\x01\0\x80\0\0", 13) + rgb +
                  std::string("\0\0\0,\0\0\0\0\x01\0\x01\0\0\x02\x02\x44\x01\0;", 19)},
      {"TGA", std::string("\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0", 18) + bgr},
  };
}

std::span<const unsigned char> bytes_of(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

void expect_texels(const std::string& sample) {
  MemoryLimit limit(1 << 20);
  const Expected<DecodedImage> image = decode_texture({"file", "picture", bytes_of(sample), limit});
  ASSERT_TRUE(image) << image.error().message();
  EXPECT_EQ(image->damage, "");
  ASSERT_EQ(image->texture.texels.size(), glm::ivec2(1));
  for (int c = 0; c < 4; ++c) EXPECT_LE(std::abs(image->texture.texels[0][c] - kColor[c]), kTolerance);
}

void expect_light(const std::filesystem::path& file) {
  const auto environment = load_environment(file);
  ASSERT_TRUE(environment) << environment.error().message();
  EXPECT_EQ((*environment)->radiance()[0], glm::vec3(kColor) / 256.0f);
}

TEST(PictureFormats, EveryRowReadsItsSample) {
  const std::map<std::string_view, std::string> all = samples();
  EXPECT_EQ(all.size(), picture_formats().size());
  for (const PictureFormat& format : picture_formats()) {
    SCOPED_TRACE(format.name);
    ASSERT_TRUE(all.contains(format.name)) << "a format needs a sample here";
    const std::string& sample = all.at(format.name);
    EXPECT_EQ(format_of(bytes_of(sample)), &format);
    std::istringstream extensions{std::string(format.extensions)};
    for (std::string extension; extensions >> extension;)
      EXPECT_EQ(format_of(std::filesystem::path("name" + extension)), &format) << extension;

    const std::filesystem::path file = own_file("sample" + extensions.str().substr(0, 4));
    std::ofstream(file, std::ios::binary) << sample;
    if (format.decode_texels) expect_texels(sample);
    if (format.decode_light) expect_light(file);
    if (format.written) {
      EXPECT_TRUE(read_picture(file) && read_picture(file)->find("R"));
    }
    if (format.decode_texels) continue;
    MemoryLimit limit(1 << 20);
    const Expected<DecodedImage> texels = decode_texture({"file", "picture", bytes_of(sample), limit});
    ASSERT_FALSE(texels);
    EXPECT_NE(texels.error().message().find("is " + std::string(format.name)), std::string::npos);
  }
}

TEST(PictureFormats, TgaFromEitherSide) {
  const std::string left("\1\2\3"), right("\4\5\6");  // blue, green, red
  for (const char descriptor : {'\0', '\x10', '\x20', '\x30'}) {
    const bool mirrored = (descriptor & 0x10) != 0;
    const std::string tga = std::string("\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x01\0\x18", 17) + descriptor +
                            (mirrored ? right + left : left + right);
    MemoryLimit limit(1 << 20);
    const Expected<DecodedImage> image = decode_texture({"file", "picture", bytes_of(tga), limit});
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->texture.texels[0], glm::u8vec4(3, 2, 1, 255));
    EXPECT_EQ(image->texture.texels[1], glm::u8vec4(6, 5, 4, 255));
  }
}

TEST(PictureFormats, TgaThatEndsWithinItsHeader) {
  const std::string tga("\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18", 17);
  MemoryLimit limit(1 << 20);
  const Expected<DecodedImage> image = decode_texture({"file", "picture", bytes_of(tga), limit});
  ASSERT_TRUE(image) << image.error().message();
  EXPECT_EQ(image->texture.texels[0], glm::u8vec4(0, 0, 0, 255));
}

TEST(PictureFormats, OthersHaveNoRow) {
  for (const char* name : {"name", "name.", "name.png.part", "name.p", "name.obj"})
    EXPECT_EQ(format_of(std::filesystem::path(name)), nullptr) << name;
  for (const char* bytes : {"", "text", "RIFF", "RIFF1234WAVE"})
    EXPECT_EQ(format_of(bytes_of(bytes)), nullptr) << bytes;
}

}  // namespace
}  // namespace pinocchio
