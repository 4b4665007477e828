#include <cstring>
#include <fstream>

#include "core/image/codecs/png.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

std::filesystem::path written(const std::string& text) {
  const std::filesystem::path path = own_file("test.ply");
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

Expected<Scene> load_text(const std::string& text, Warnings* warnings = nullptr) {
  return load_scene(written(text), warnings);
}

std::string error_of(const std::string& text) {
  const Expected<Scene> scene = load_text(text);
  EXPECT_FALSE(scene);
  return scene ? "" : scene.error().message();
}

const std::string kHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";
const std::string kRows = "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 255 255\n";

TEST(LoadPly, AsciiWithColorsAndAQuad) {
  const Expected<Scene> scene = load_text(kHeader + kRows + "4 0 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles.size(), 2u);
  EXPECT_EQ(scene->mesh->positions[2], glm::vec3(1, 1, 0));
  ASSERT_EQ(scene->mesh->colors.size(), 4u);
  EXPECT_EQ(scene->mesh->colors[1], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(scene->mesh->normals[0], glm::vec3(0.0f));
}

// Colours that are whole numbers are 0 to 255. Faces before their vertices; none at all.
TEST(LoadPly, AnyOrderAndAnyWholeNumbers) {
  const std::string
      format = "ply\nformat ascii 1.0\n",
      vertices =
          "element vertex 4\nproperty float x\n"
          "property float y\nproperty float z\nproperty int red\nproperty int green\nproperty int blue\n",
      face = "property list uchar int vertex_indices\n";
  const Expected<Scene> scene =
      load_text(format + "element face 2\n" + face + vertices +
                "element other 1\nproperty int n\nend_header\n3 0 1 2\n3 0 2 3\n" + kRows + "7\n");
  ASSERT_TRUE(scene) << scene.error().message();
  ASSERT_EQ(scene->mesh->triangles.size(), 2u);
  EXPECT_EQ(scene->mesh->triangles[1], glm::uvec3(0, 2, 3));
  EXPECT_EQ(scene->mesh->colors[1], glm::vec4(0, 1, 0, 1));
  EXPECT_NE(error_of(format + "element face 2\n" + face + vertices + "end_header\n3 0 1 2\n3 0 2 9\n" + kRows)
                .find("test.ply:14: a face names vertex 9, there are 4"),
            std::string::npos);
  const Expected<Scene> cloud =
      load_scene(written(format + vertices + "element face 0\nend_header\n" + kRows), {.point_size = 0.1f});
  ASSERT_TRUE(cloud) << cloud.error().message();
  EXPECT_GT(cloud->mesh->triangles.size(), 0u);  // of balls
}

// The same rows in bytes.
std::string binary(bool big, const std::string& format) {
  std::string bytes = "ply\nformat " + format +
                      " 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n"
                      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
                      "property list uint8 uint32 vertex_index\nend_header\n";
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (big) std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof value);
  };
  for (int i = 0; i < 3; ++i) {
    put(static_cast<float>(i == 1));
    put(static_cast<double>(i == 2));
    put(static_cast<std::int16_t>(-7));
    put(0.0f);
    put(0.0f);
    put(1.0f);
  }
  put(std::uint8_t{3});
  for (std::uint32_t i = 0; i < 3; ++i) put(i);
  return bytes;
}

TEST(LoadPly, BothBinaries) {
  for (const bool big : {false, true}) {
    const Expected<Scene> scene = load_text(binary(big, big ? "binary_big_endian" : "binary_little_endian"));
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->positions[1], glm::vec3(1, 0, -7));
    EXPECT_EQ(scene->mesh->positions[2], glm::vec3(0, 1, -7));
    EXPECT_EQ(scene->mesh->normals[0], glm::vec3(0, 0, 1));
    EXPECT_TRUE(scene->mesh->colors.empty());
    EXPECT_EQ(scene->mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  }
}

TEST(LoadPly, StripsEndAtMinusOne) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 1 1 0\n";
  const Expected<Scene> scene = load_text(header + "8 0 1 2 3 -1 3 2 1\n");
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}}));
}

TEST(LoadPly, FacesOnVerticesThatAreNoFiniteNumbersAreLeftOut) {
  Warnings warnings;
  const Expected<Scene> scene = load_text(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nnan 0 0\n"
      "3 0 1 2\n4 0 1 3 4\n5 0 1 2 3 4\n",
      &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles.size(), 3u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.begin()->message().find("no finite numbers are left out (and in 1 more place)"),
            std::string::npos);
}

TEST(LoadPly, OtherNumbersThatAreNotFiniteAreLeftOut) {
  Warnings warnings;
  const Expected<Scene> scene = load_text(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property float red\nproperty float green\nproperty float blue\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 nan 0 1 0 0 0\n1 0 0 0 0 1 inf 0 0\n0 1 0 0 0 1 0 0 0\n3 0 1 2\n",
      &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->normals[0], glm::vec3(0.0f));
  EXPECT_EQ(scene->mesh->normals[1], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene->mesh->colors[1], glm::vec4(1.0f));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.begin()->message().find("are left out (and in 1 more place)"), std::string::npos)
      << warnings.begin()->message();
}

TEST(LoadPly, FacesMayHaveColors) {
  std::string header = kHeader.substr(0, kHeader.find("property uchar red")) +
                       "element face 3\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\nend_header\n";
  const Expected<Scene> scene =
      load_text(header + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n3 2 1 0 255 0 0\n");
  ASSERT_TRUE(scene) << scene.error().message();
  const Mesh& mesh = *scene->mesh;
  ASSERT_EQ(mesh.triangles.size(), 3u);
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  EXPECT_EQ(mesh.positions.size(), 6u);  // two are of two colours
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.colors[mesh.triangles[0][i]], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh.colors[mesh.triangles[1][i]], glm::vec4(0, 1, 0, 1));
  }
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(2, 1, 0));
  EXPECT_EQ(mesh.positions[mesh.triangles[1].y], glm::vec3(1, 1, 0));
}

TEST(LoadPly, TexturesOfVerticesAndOfFaces) {
  Texture texture;
  texture.texels = Image<glm::u8vec4>(glm::ivec2(2, 1), glm::u8vec4(255));
  std::ofstream(own_file("two words.png"), std::ios::binary) << encode_png(texture.texels);
  const std::string begin =
      "ply\nformat ascii 1.0\ncomment TextureFile two words.png\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\n";
  const std::string faces = "property list uchar int vertex_indices\n";
  Warnings warnings;
  const Expected<Scene> vertices =
      load_text(begin + "property float s\nproperty float t\nelement face 1\n" + faces +
                    "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
                &warnings);
  ASSERT_TRUE(vertices) << vertices.error().message();
  EXPECT_TRUE(warnings.empty());
  ASSERT_NE(vertices->mesh->maps_of(0), nullptr);
  EXPECT_TRUE(vertices->mesh->maps_of(0)->base_color.used());
  EXPECT_EQ(vertices->mesh->texcoords, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}));  // v grows upwards

  const Expected<Scene> corners =
      load_text(begin + "element face 2\n" + faces + "property list uchar float texcoord\nend_header\n" +
                    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1\n3 0 2 1 6 0 0 .5 1 1 0\n",
                &warnings);
  ASSERT_TRUE(corners) << corners.error().message();
  EXPECT_TRUE(warnings.empty());
  const Mesh& mesh = *corners->mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 3, 1}}));  // corner 2 lies elsewhere
  EXPECT_EQ(mesh.texcoords, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}, {0.5, 0}}));

  ASSERT_TRUE(load_text(begin + "element face 1\n" + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                        &warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("no texture coordinates"), std::string::npos);
}

TEST(LoadPly, WhatIsLeftOutIsSaid) {
  Warnings warnings;
  std::string points =
      kHeader.substr(0, kHeader.find("element face")) + "element edge 1\nproperty int vertex1\nend_header\n";
  const Expected<Scene> scene = load_text(points + kRows + "0\n", &warnings);
  ASSERT_FALSE(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("element edge"), std::string::npos);
  EXPECT_NE(scene.error().message().find("only points; draw them with --point-size D"), std::string::npos);
}

// A strip of `cells` squares, each of two triangles, in bytes of the other order; all faces but `left_out`
// are in the header's count, which names these types.
std::string strip(int cells, const char* count_type, int left_out = 0) {
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex " + std::to_string(2 * cells + 2) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(2 * cells - left_out) + "\nproperty list " + count_type +
                      " int vertex_indices\nend_header\n";
  const auto put = [&bytes](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof value);
  };
  for (int i = 0; i < 2 * cells + 2; ++i)
    put(static_cast<float>(i / 2)), put(static_cast<float>(i % 2)), put(0.0f);
  for (int i = 0; i < 2 * cells; ++i) {
    put(3);
    for (const int corner : {0, 1, 2}) put(i + corner);
  }
  return bytes;
}

TEST(LoadPly, HeadersThatDoNotFitTheirDataAreErrors) {
  EXPECT_TRUE(load_text(strip(400, "int")));
  const std::string rubbish = error_of(strip(400, "uchar"));  // counts of four bytes are read as four counts
  EXPECT_NE(rubbish.find("its header does not fit its data: 600 of 800 faces"), std::string::npos) << rubbish;
  EXPECT_NE(error_of(strip(400, "ushort")).find("does not fit its data"), std::string::npos);
  std::string ascii = strip(400, "int");
  ascii.replace(ascii.find("binary_big_endian"), 17, "ascii");
  EXPECT_NE(error_of(ascii).find("its header says ascii, its data is binary"), std::string::npos);
  std::string text = kHeader + kRows + "4 0 1 2 3\n";
  text.replace(text.find("ascii"), 5, "binary_little_endian");
  EXPECT_NE(error_of(text).find("its header says binary, its data is text"), std::string::npos);
  EXPECT_NE(error_of(kHeader + kRows + "4 0 1 2 0.5\n").find("names vertex 0.5"), std::string::npos);
  EXPECT_NE(error_of(kHeader + kRows + "3.5 0 1 2\n").find("a list of 3.5 does not fit"), std::string::npos);
}

TEST(LoadPly, BytesBehindTheLastElementAreSaid) {
  Warnings warnings;
  EXPECT_TRUE(load_text(strip(400, "int") + "\n", &warnings));
  EXPECT_TRUE(warnings.empty());
  const Expected<Scene> scene = load_text(strip(400, "int", 3), &warnings);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->mesh->triangles.size(), 797u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("bytes follow its last element (48)"), std::string::npos);
}

TEST(LoadPly, BadFilesAreErrorsThatSayWhat) {
  EXPECT_NE(error_of("hello").find("is not PLY"), std::string::npos);
  EXPECT_NE(error_of("ply\nformat ascii 1.0\n").find("end_header"), std::string::npos);
  EXPECT_NE(error_of("ply\nformat pdf 1.0\nend_header\n").find(":2: its format 'pdf'"), std::string::npos);
  EXPECT_NE(error_of(kHeader + kRows + "4 0 1 2 9\n").find("names vertex 9"), std::string::npos);
  EXPECT_NE(error_of(kHeader + kRows + "4 0 1 two 3\n").find(":18: cannot read vertex_indices"),
            std::string::npos);
  EXPECT_NE(error_of(kHeader + kRows + "4 0 1 2\n").find("ends too early"), std::string::npos);
  std::string claim = kHeader;
  claim.replace(claim.find("vertex 4"), 8, "vertex 4000000000");
  EXPECT_NE(error_of(claim + kRows).find("too short"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
