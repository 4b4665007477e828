// glTF files with packed data: data URIs, chunks, Draco, meshopt, instances.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop
#include <meshoptimizer.h>

#include <algorithm>
#include <array>

#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

// The triangle's JSON with this as its one buffer.
Json with_buffer(const std::string& bytes) {
  Json json = triangle_json();
  json["buffers"] = {
      {{"uri", "data:application/octet-stream;base64," + base64(bytes)}, {"byteLength", bytes.size()}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  return json;
}

// The triangle's buffer: positions, then indices.
std::string triangle_bytes() {
  std::string bytes(56, '\0');
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint16_t indices[4] = {0, 1, 2, 3};
  std::memcpy(bytes.data(), positions, 48);
  std::memcpy(bytes.data() + 48, indices, 8);
  return bytes;
}

TEST(LoadPacked, BuffersInTheFile) {
  Json json = with_buffer(triangle_bytes());
  json["bufferViews"] = triangle_json()["bufferViews"];
  EXPECT_EQ(load_good(json).mesh->positions[1], glm::vec3(1, 0, 0));
  json["buffers"][0]["byteLength"] = 57;
  EXPECT_NE(error_of(json).find("holds 56 bytes"), std::string::npos);
}

TEST(LoadPacked, DataUrisNeedNotBeBase64) {
  const std::string bytes = triangle_bytes();
  std::string uri = "data:application/octet-stream,";
  for (const char byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(byte);
    if (value == '?')
      uri += '?';  // stands for itself
    else
      uri += {'%', kDigits[value >> 4], kDigits[value & 15]};
  }
  Json json = triangle_json();
  json["buffers"] = {{{"uri", uri}, {"byteLength", bytes.size()}}};
  EXPECT_EQ(load_good(json).mesh->positions[1], glm::vec3(1, 0, 0));
}

TEST(LoadPacked, AddressesAreNotFetchedAndSaid) {
  Json json = triangle_json();
  json["buffers"][0]["uri"] = "http://example.com/models/other.bin";
  EXPECT_NE(
      error_of(json).find("other.bin: is an address, not a file, and nothing is fetched from the network; "
                          "download it and name the copy"),
      std::string::npos);
  json["buffers"][0]["uri"] = "https://example.com/models/test.bin";  // a copy lies beside the file
  EXPECT_TRUE(load(json));
  Warnings warnings;
  ASSERT_TRUE(load(textured_json({{"uri", "https://example.com/a%20b.png"}}), &warnings));
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const Warning& warning) {
    return warning.message().find("a b.png: is an address, not a file") != std::string::npos;
  }));
  const Expected<Scene> scene = load_scene("https://example.com/a.glb");
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find("is an address, not a file"), std::string::npos);
}

// A GLB's chunk as it should be, but for its padding.
std::string chunk(std::uint32_t type, std::string bytes, std::size_t multiple, char padding) {
  const auto length = static_cast<std::uint32_t>(bytes.size());
  while (bytes.size() % multiple != 0) bytes.push_back(padding);
  std::string head(8, '\0');
  std::memcpy(head.data(), &length, 4);
  std::memcpy(head.data() + 4, &type, 4);
  return head + bytes;
}

Expected<Scene> load_glb(const std::string& chunks, Warnings& warnings) {
  const std::array<std::uint32_t, 3> header{0x46546c67, 2, static_cast<std::uint32_t>(12 + chunks.size())};
  std::ofstream(own_file("chunks.glb"), std::ios::binary)
      << std::string(reinterpret_cast<const char*>(header.data()), 12) << chunks;
  return load_scene(own_file("chunks.glb"), &warnings);
}

TEST(LoadPacked, ChunksNeedNotBeAligned) {
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  Json json = triangle_json();
  json["buffers"][0].erase("uri");
  std::string text = json.dump();
  while (text.size() % 4 != 1) text.push_back(' ');
  Warnings warnings;
  for (const std::size_t multiple : {std::size_t{4}, std::size_t{1}}) {
    const Expected<Scene> scene = load_glb(
        chunk(kJson, text, multiple, ' ') + chunk(kBinary, triangle_bytes(), multiple, '\0'), warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(warnings.size(), multiple == 1 ? 1u : 0u);
  }
  EXPECT_NE(warnings[0].message().find("not padded to multiples of 4"), std::string::npos);
  // Zeros pad the JSON, its length counts them; bytes follow that are no chunk.
  Warnings none;
  ASSERT_TRUE(load_glb(chunk(kJson, text + std::string(3, '\0'), 4, ' ') +
                           chunk(kBinary, triangle_bytes(), 4, '\0') + std::string(12, '\xff'),
                       none));
  EXPECT_TRUE(none.empty());
  // The last chunk counts padding that is not there.
  std::string cut = chunk(kBinary, triangle_bytes() + std::string(3, '\0'), 1, '\0');
  cut.resize(cut.size() - 3);
  ASSERT_TRUE(load_glb(chunk(kJson, text, 4, ' ') + cut, none));
  EXPECT_EQ(none.size(), 1u);
}

// They are kept from the JSON library, but for those with escapes.
TEST(LoadPacked, LongBuffersInTheFile) {
  std::string bytes = triangle_bytes();
  for (std::size_t i = bytes.size(); i < 20001; ++i) bytes.push_back(static_cast<char>(7 * i));
  Json json = with_buffer(bytes);
  json["bufferViews"] = triangle_json()["bufferViews"];
  json["images"] = {
      {{"uri", "data:image/x-portable-pixmap;base64," + base64("P6 20 20 255\n" + std::string(1200, 'm'))}}};
  json["textures"] = {{{"source", 0}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  std::string text = json.dump();
  for (const bool escaped : {false, true}) {
    if (escaped) text.replace(text.find("application/octet"), 17, "application\\/octet");
    std::ofstream(own_file("long.gltf")) << text;
    const Expected<Scene> scene = load_scene(own_file("long.gltf"));
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->positions[1], glm::vec3(1, 0, 0));
    ASSERT_EQ(scene->mesh->textures.size(), 1u);
    EXPECT_EQ(scene->mesh->textures[0].image().at(19, 19), glm::u8vec4('m', 'm', 'm', 255));
  }
  json["buffers"][0]["byteLength"] = 20002;
  EXPECT_NE(error_of(json).find("holds 20001 bytes"), std::string::npos);
  json["buffers"][0]["byteLength"] = 56;
  json["buffers"][0]["uri"] = "data:aside,7";  // no number of ours, so the text 7
  EXPECT_NE(error_of(json).find("holds 1 bytes"), std::string::npos);
}

// Draco's encoders store quantised numbers as plain integers; the accessor's `normalized` maps them to 0 to
// 1, or -1 to 1.
TEST(LoadPacked, DracosIntegersAreNormalizedAsTheAccessorSays) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int places = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_INT16),
            colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8),
            normals = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_INT8);
  const std::array<std::array<std::int16_t, 3>, 3> p{{{0, 0, 0}, {32767, 0, 0}, {0, -32768, 0}}};
  builder.SetAttributeValuesForFace(places, draco::FaceIndex(0), p[0].data(), p[1].data(), p[2].data());
  const std::array<std::uint8_t, 4> color{51, 102, 255, 255};
  builder.SetAttributeValuesForFace(colors, draco::FaceIndex(0), color.data(), color.data(), color.data());
  const std::array<std::int8_t, 3> normal{0, 0, -128};
  builder.SetAttributeValuesForFace(normals, draco::FaceIndex(0), normal.data(), normal.data(),
                                    normal.data());
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  Json json = with_buffer({buffer.data(), buffer.size()});
  const auto accessor = [](int type, const char* shape) {
    return Json{{"componentType", type}, {"normalized", true}, {"count", 3}, {"type", shape}};
  };
  json["accessors"] = {accessor(5122, "VEC3"),
                       {{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}},
                       accessor(5121, "VEC4"),
                       accessor(5120, "VEC3")};
  json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization"};
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["attributes"] = {{"POSITION", 0}, {"COLOR_0", 2}, {"NORMAL", 3}};
  primitive["indices"] = 1;
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}, {"NORMAL", 2}}}};
  const Scene scene = load_good(json);
  EXPECT_EQ(scene.mesh->bounds().hi, glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.mesh->bounds().lo, glm::vec3(0, -1, 0));
  ASSERT_EQ(scene.mesh->colors.size(), 3u);
  EXPECT_NEAR(scene.mesh->colors[0].r, 0.2f, 1e-6f);
  EXPECT_EQ(scene.mesh->normals[0], glm::vec3(0, 0, -1));
}

TEST(LoadPacked, Draco) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0};
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), a, b, c);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
  Json json = with_buffer({buffer.data(), buffer.size()});
  json["accessors"] = {{{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                       {{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}};
  json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", mesh->attribute(id)->unique_id()}}}};
  const Scene scene = load_good(json);
  ASSERT_EQ(scene.mesh->triangles.size(), 1u);
  double area = 0.0;
  for (int i = 0; i < 3; ++i)
    area += static_cast<double>(glm::length(scene.mesh->positions[scene.mesh->triangles[0][i]]));
  EXPECT_NEAR(area, 2.0, 1e-3);
  primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 9;
  EXPECT_NE(error_of(json).find("lacks its attribute POSITION"), std::string::npos);
  json["buffers"][0]["uri"] = "data:;base64,AAAA";
  json["buffers"][0]["byteLength"] = 3;
  json["bufferViews"][0]["byteLength"] = 3;
  EXPECT_NE(error_of(json).find("KHR_draco_mesh_compression cannot be unpacked"), std::string::npos);
}

TEST(LoadPacked, Meshopt) {
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const unsigned indices[6] = {0, 1, 2, 2, 1, 3};
  std::string vertices(meshopt_encodeVertexBufferBound(4, 12), '\0'),
      triangles(meshopt_encodeIndexBufferBound(6, 4), '\0');
  vertices.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(vertices.data()),
                                             vertices.size(), positions, 4, 12));
  triangles.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(triangles.data()),
                                             triangles.size(), indices, 6));
  Json json = with_buffer(vertices + triangles);
  json["buffers"].push_back(
      {{"byteLength", 56}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  json["bufferViews"] = {{{"buffer", 1}, {"byteLength", 48}},
                         {{"buffer", 1}, {"byteOffset", 48}, {"byteLength", 12}}};
  json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                     {"byteLength", vertices.size()},
                                                                     {"byteStride", 12},
                                                                     {"count", 4},
                                                                     {"mode", "ATTRIBUTES"}};
  json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                     {"byteOffset", vertices.size()},
                                                                     {"byteLength", triangles.size()},
                                                                     {"byteStride", 2},
                                                                     {"count", 6},
                                                                     {"mode", "TRIANGLES"}};
  json["accessors"][1]["count"] = 6;
  json["extensionsRequired"] = {"EXT_meshopt_compression"};
  const Scene scene = load_good(json);
  EXPECT_EQ(scene.mesh->triangles.size(), 2u);
  EXPECT_EQ(scene.mesh->positions[3], glm::vec3(1, 1, 0));
  Json& packed = json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
  packed["byteStride"] = 13;
  EXPECT_NE(error_of(json).find("stride"), std::string::npos);
  packed["byteStride"] = 256;
  packed["count"] = std::size_t{1} << 40;
  EXPECT_NE(error_of(json).find("--load-limit"), std::string::npos);
}

TEST(LoadPacked, Instances) {
  Json json = triangle_json();
  // Two of the positions, as translations: (0,0,0) and (1,0,0).
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  json["nodes"][0]["translation"] = {0, 0, 5};
  json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Scene scene = load_good(json);
  ASSERT_EQ(scene.mesh->triangles.size(), 2u);
  EXPECT_EQ(scene.mesh->positions[scene.mesh->triangles[1].y], glm::vec3(2, 0, 5));
}

TEST(LoadPacked, Utf16AndByteOrderMarks) {
  const std::string text = triangle_json().dump();
  std::string utf16 = "\xff\xfe";
  for (const char c : text) utf16 += std::string{c, '\0'};
  std::ofstream(own_file("wide.gltf"), std::ios::binary) << utf16;
  EXPECT_TRUE(load_scene(own_file("wide.gltf")));
  std::ofstream(own_file("bom.gltf"), std::ios::binary) << "\xef\xbb\xbf" << text;
  EXPECT_TRUE(load_scene(own_file("bom.gltf")));
}

TEST(LoadPacked, WhatOnlyKhrMeshoptKnowsIsSaid) {
  const auto khr_error = [](const std::string& packed, const char* filter) {
    Json json = with_buffer(packed);
    json["bufferViews"][0]["extensions"]["KHR_meshopt_compression"] = {
        {"buffer", 0}, {"byteLength", packed.size()}, {"byteStride", 4},
        {"count", 1},  {"mode", "ATTRIBUTES"},        {"filter", filter}};
    return error_of(json);
  };
  const std::string version1 = khr_error("\xa1" + std::string(40, '\0'), "NONE");
  EXPECT_NE(
      version1.find("KHR_meshopt_compression is packed with version 1 of the vertex codec, which is not "
                    "read; pack it with EXT_meshopt_compression"),
      std::string::npos)
      << version1;
  EXPECT_NE(khr_error("\xa0" + std::string(40, '\0'), "COLOR").find("the filter 'COLOR', which is not read"),
            std::string::npos);
  EXPECT_NE(khr_error("\x01" + std::string(40, '\0'), "NONE").find("(KHR_meshopt_compression, mode"),
            std::string::npos);
}

}  // namespace
}  // namespace pinocchio
