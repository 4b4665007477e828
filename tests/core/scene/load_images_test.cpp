// Pictures of every format that a texture may have, whole and damaged.
#include <sys/stat.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <fstream>
#include <memory>

#include "core/image/codecs/formats.h"
#include "core/image/codecs/png.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr int kSide = 24;

Texture gradient() {
  Texture texture;
  texture.texels = Image<glm::u8vec4>({kSide, kSide});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) texture.texels.at(x, y) = glm::u8vec4(10 * x, 10 * y, 120, 255);
  return texture;
}

std::string webp_of(const Texture& texture) {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(
      reinterpret_cast<const std::uint8_t*>(texture.texels.pixels().data()), kSide, kSide, 4 * kSide, &bytes);
  const std::string webp(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return webp;
}

std::string jpeg_of(const Texture& texture, int subsampling) {
  const std::unique_ptr<void, int (*)(tjhandle)> context(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(context.get(), reinterpret_cast<const unsigned char*>(texture.texels.pixels().data()),
                        kSide, 0, kSide, TJPF_RGBA, &bytes, &size, subsampling, 95, TJFLAG_ACCURATEDCT),
            0);
  const std::string jpeg(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  return jpeg;
}

std::span<const unsigned char> image_bytes(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

Expected<DecodedImage> decode(const std::string& bytes, std::uint64_t most_bytes = 1 << 20) {
  MemoryLimit limit(most_bytes);
  return decode_texture({"scene.glb", "picture", image_bytes(bytes), limit});
}

int largest_difference(const Texture& a, const Texture& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.texels.pixels().size(); ++i)
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a.texels[i][c] - b.texels[i][c]));
  return largest;
}

TEST(LoadImages, EachFormatGivesItsTexels) {
  const Texture texture = gradient();
  const std::pair<std::string, int> files[] = {// and by how much a texel may differ
                                               {encode_png(texture.texels), 0},
                                               {webp_of(texture), 0},
                                               {jpeg_of(texture, TJSAMP_444), 4},
                                               {jpeg_of(texture, TJSAMP_420), 12}};
  for (const auto& [bytes, tolerance] : files) {
    const Expected<DecodedImage> image = decode(bytes);
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_TRUE(image->damage.empty()) << image->damage;
    ASSERT_EQ(image->texture.texels.size(), glm::ivec2(kSide));
    EXPECT_LE(largest_difference(image->texture, texture), tolerance);
  }
}

// A height below zero says that the first row is the top one.
TEST(LoadImages, ABmpMayBeginWithItsTopRow) {
  const auto bmp = [](std::int32_t height) {
    std::string bytes("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0", 22);  // 2 pixels wide
    bytes.append(reinterpret_cast<const char*>(&height), 4);
    bytes.append("\x01\0\x18\0\0\0\0\0\x10\0\0\0", 12).append(16, '\0');  // 24 bits, 16 bytes
    return bytes + std::string("\x01\x02\x03\x04\x05\x06\0\0\x07\x08\x09\x0a\x0b\x0c\0\0", 16);
  };
  const Expected<DecodedImage> up = decode(bmp(2)), down = decode(bmp(-2));
  ASSERT_TRUE(up && down);
  EXPECT_EQ(up->texture.texels.at(0, 1), glm::u8vec4(3, 2, 1, 255));
  EXPECT_EQ(down->texture.texels.at(0, 0), glm::u8vec4(3, 2, 1, 255));
  EXPECT_EQ(down->texture.texels.at(1, 1), up->texture.texels.at(1, 0));
  EXPECT_FALSE(decode(bmp(std::numeric_limits<std::int32_t>::min())));
}

// Of 24 bits, from the bottom row up.
std::string tga_of(const Texture& texture) {
  const glm::ivec2 size = texture.texels.size();
  std::string bytes("\0\0\x02\0\0\0\0\0\0\0\0\0", 12);
  for (const int side : {size.x, size.y})
    for (const int shift : {0, 8}) bytes += static_cast<char>(side >> shift);
  bytes += std::string("\x18\0", 2);
  for (int y = size.y; y-- > 0;)
    for (int x = 0; x < size.x; ++x)
      for (const int c : {2, 1, 0}) bytes += static_cast<char>(texture.texels.at(x, y)[c]);
  return bytes;
}

// Cut off, or with bits turned: an error, or what is there of it. Never a crash, never more than the limit.
TEST(LoadImages, DamagedOnesAreErrorsOrSaySo) {
  Random random(7);
  EXPECT_EQ(decode(tga_of(gradient()))->damage, "");
  EXPECT_EQ(largest_difference(decode(tga_of(gradient()))->texture, gradient()), 0);
  for (const std::string& whole : {encode_png(gradient().texels), webp_of(gradient()),
                                   jpeg_of(gradient(), TJSAMP_420), tga_of(gradient())}) {
    for (std::size_t cut = 0; cut + 16 < whole.size(); cut += 1 + whole.size() / 200) {
      const Expected<DecodedImage> image = decode(whole.substr(0, cut));
      EXPECT_TRUE(!image || !image->damage.empty()) << cut << " of " << whole.size();
    }
    for (int i = 0; i < 300; ++i) {
      std::string bytes = whole;
      for (int k = 0; k < 4; ++k)
        bytes[random.next() % bytes.size()] ^= static_cast<char>(1u << random.next() % 8);
      (void)decode(bytes);
    }
  }
}

// Files with any white, 8 bits or 16, high byte first.
TEST(LoadImages, NetpbmGreyAndRgb) {
  const auto texels = [](const std::string& bytes) {
    const Expected<DecodedImage> image = decode(bytes);
    EXPECT_TRUE(image) << image.error().message();
    const auto pixels = image->texture.texels.pixels();
    return std::vector<glm::u8vec4>(pixels.begin(), pixels.end());
  };
  EXPECT_EQ(texels("P6\n# by hand\n2 1 # wide\n100\n" + std::string("\x64\x32\x00\x00\x64\x7f", 6)),
            (std::vector<glm::u8vec4>{{255, 128, 0, 255}, {0, 255, 255, 255}}));
  EXPECT_EQ(texels("P6 1 1 65535\n" + std::string("\xff\xff\x80\x00\x00\xff", 6)),
            (std::vector<glm::u8vec4>{{255, 128, 1, 255}}));
  EXPECT_EQ(texels("P5 2 1 255\n" + std::string("\x07\xc8")),
            (std::vector<glm::u8vec4>{{7, 7, 7, 255}, {200, 200, 200, 255}}));
  EXPECT_EQ(decode("P6 9 1 260\n1234")->damage, "it is cut off");
  for (const char* bad : {"P6", "P6 1", "P6 1 1", "P6 1 1 0 ", "P6 1 1 65536 123", "P6 99999999999 1 255 ",
                          "P6 0 1 255 ", "P6 -1 1 255 "})
    EXPECT_FALSE(decode(bad)) << bad;
}

TEST(LoadImages, NoneTakesMoreThanTheLimit) {
  for (const std::string& bytes :
       {encode_png(gradient().texels), webp_of(gradient()), jpeg_of(gradient(), TJSAMP_444)}) {
    const Expected<DecodedImage> image = decode(bytes, 100);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message().find("24 x 24 pixels"), std::string::npos);
    EXPECT_NE(image.error().message().find("--load-limit"), std::string::npos);
  }
}

// What a KTX2 or DDS picture is said by name.
TEST(LoadImages, FormatsThatAreNotRead) {
  EXPECT_NE(decode(std::string("\xabKTX 20\xbb\r\n\x1a\n", 12)).error().message().find("KTX2"),
            std::string::npos);
  EXPECT_NE(decode("DDS |").error().message().find("DDS"), std::string::npos);
  EXPECT_NE(decode("text").error().message().find("format"), std::string::npos);
}

TEST(LoadImages, Utf16ObjAndMtlAndPipesAsMtl) {
  const auto wide = [](const std::string& text) {
    std::string bytes = "\xfe\xff";
    for (const char c : text) bytes += std::string{'\0', c};
    return bytes;
  };
  std::ofstream(own_file("wide.mtl"), std::ios::binary) << wide("newmtl red\nKd 1 0 0\n");
  std::ofstream(own_file("wide.obj"), std::ios::binary)
      << wide("mtllib wide.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  EXPECT_EQ(load_or_die(own_file("wide.obj")).mesh->material_of(0).diffuse, glm::vec3(1, 0, 0));
  std::filesystem::remove(own_file("pipe.mtl"));
  ASSERT_EQ(mkfifo(own_file("pipe.mtl").c_str(), 0600), 0);
  std::ofstream(own_file("piped.obj")) << "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  Warnings warnings;
  ASSERT_TRUE(load_scene(own_file("piped.obj"), &warnings));
  EXPECT_NE(warnings[0].message().find("pipe or device"), std::string::npos);
}

// The fast way halves bytes and numbers in one pass; odd sides go the general way.
TEST(LoadImages, SmallerLevelsAreMeans) {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.resize(3);
  mesh.texcoords.resize(3);
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_materials = {0};
  make_maps(mesh, mesh.materials.emplace_back()).normal.texture = 0;  // no colour: bytes are numbers
  Texture& texture = mesh.textures.edit().emplace_back();
  texture.texels = Image<glm::u8vec4>({4, 2}, glm::u8vec4(0));
  texture.texels.at(0, 0) = glm::u8vec4(40, 0, 0, 255);
  texture.texels.at(3, 1) = glm::u8vec4(0, 80, 0, 255);
  const Mesh finished(mesh);
  const TexelBlocks& blocks = finished.textures[0].blocks;
  ASSERT_EQ(blocks.levels(), 3);
  EXPECT_EQ(blocks.at(0, 3, 1), glm::u8vec4(0, 80, 0, 255));
  EXPECT_EQ(blocks.at(1, 0, 0), glm::u8vec4(10, 0, 0, 64));
  EXPECT_EQ(blocks.at(1, 1, 0), glm::u8vec4(0, 20, 0, 64));
  EXPECT_EQ(blocks.at(2, 0, 0), glm::u8vec4(5, 10, 0, 64));
  mesh.textures.edit()[0].texels = Image<glm::u8vec4>({3, 1}, glm::u8vec4(30, 60, 90, 255));
  EXPECT_EQ(Mesh(mesh).textures[0].blocks.at(1, 0, 0), glm::u8vec4(30, 60, 90, 255));
}

// New texels for a texture that a mesh has finished.
TEST(LoadImages, TexelsOfAFinishedTextureAreReplaced) {
  MeshData mesh;
  make_maps(mesh, mesh.materials.emplace_back()).metallic_roughness.texture = 0;
  mesh.textures.edit().push_back({"rough", Image<glm::u8vec4>({64, 64}, glm::u8vec4(255))});
  MeshData finished = Mesh(mesh);
  EXPECT_EQ(finished.textures[0].size(), glm::ivec2(64));
  EXPECT_EQ(finished.textures[0].least_green.size(), 256u);
  finished.textures.edit()[0].texels = Image<glm::u8vec4>({2, 1}, glm::u8vec4(0));
  EXPECT_EQ(finished.textures[0].image().size(), glm::ivec2(2, 1));
  const Mesh again(finished);
  EXPECT_EQ(again.textures[0].levels(), 2);
  EXPECT_TRUE(again.textures[0].least_green.empty());
}

// Byte k of a square: the least of the texels up to kGreenSide << k around it, beyond edges those of the
// other side. Where a side is no multiple of a square's, of some more.
TEST(LoadImages, TheLeastGreenAroundIsFound) {
  constexpr int kSquare = Texture::kGreenSide;
  for (const glm::ivec2 size : {glm::ivec2(64), {128, 64}, {71, 90}}) {
    MeshData mesh;
    make_maps(mesh, mesh.materials.emplace_back()).metallic_roughness.texture = 0;
    Image<glm::u8vec4> texels(size);
    Random random(3);
    for (glm::u8vec4& texel : texels.pixels())
      texel.g = static_cast<std::uint8_t>(255 - random.next() % 256 / 4);
    mesh.textures.edit().push_back({"rough", texels});
    const Mesh finished(mesh);
    const std::vector<std::uint32_t>& found = finished.textures[0].least_green;
    const glm::ivec2 squares = (size + kSquare - 1) / kSquare;
    ASSERT_EQ(found.size(), as_size(squares.x * squares.y));
    for (int k = 0; k < Texture::kGreenReaches; ++k)
      for (std::size_t i = 0; i < found.size(); ++i) {
        const int reach = kSquare << k;
        const glm::ivec2 at = kSquare * glm::ivec2(as_int(i) % squares.x, as_int(i) / squares.x);
        unsigned least = 255;
        for (int y = at.y - reach; y < at.y + kSquare + reach; ++y)
          for (int x = at.x - reach; x < at.x + kSquare + reach; ++x)
            least = std::min<unsigned>(least, texels.at((x + size.x) % size.x, (y + size.y) % size.y).g);
        const unsigned byte = found[i] >> 8 * k & 0xffu;
        ASSERT_LE(byte, least) << size.x << ", " << i << ", " << k;
        if (size % kSquare == glm::ivec2(0)) {
          ASSERT_EQ(byte, least) << size.x << ", " << i << ", " << k;
        }
      }
  }
}

// Sides that are no multiples of a block's, and less than one.
TEST(LoadImages, BlocksHoldWhatRowsHeld) {
  for (const glm::ivec2 size : {glm::ivec2(1), {3, 2}, {4, 4}, {5, 9}, {17, 1}}) {
    Image<glm::u8vec4> largest(size);
    for (std::size_t i = 0; i < largest.pixels().size(); ++i) largest[i] = glm::u8vec4(i, 1, 2, 3);
    std::vector<glm::u8vec4> smaller;
    for (glm::ivec2 level = size; level != glm::ivec2(1);) {
      level = glm::max(level / 2, glm::ivec2(1));
      for (int i = 0; i < level.x * level.y; ++i) smaller.emplace_back(7 * i, level.x, level.y, 4);
    }
    const TexelBlocks blocks(largest, smaller);
    EXPECT_EQ(blocks.size(0), size);
    auto from = smaller.begin();
    for (int level = 0; level < blocks.levels(); ++level) {
      const Image<glm::u8vec4> rows = blocks.level(level);
      for (int y = 0; y < rows.height(); ++y)
        for (int x = 0; x < rows.width(); ++x) {
          const glm::u8vec4 texel = level == 0 ? largest.at(x, y) : *from++;
          EXPECT_EQ(rows.at(x, y), texel) << level << " " << x << " " << y;
          EXPECT_EQ(blocks.at(level, x, y), texel);
        }
    }
    EXPECT_EQ(from, smaller.end());
  }
}

}  // namespace
}  // namespace pinocchio
