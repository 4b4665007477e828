// What glTF packs: Draco, meshopt, instances; and what a file may claim.
#include <spng.h>
#include <sys/stat.h>

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

std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63]);
  }
  return text;
}

// The triangle's JSON with this as its one buffer.
Json with_buffer(const std::string& bytes) {
  Json json = triangle_json();
  json["buffers"] = {
      {{"uri", "data:application/octet-stream;base64," + base64(bytes)}, {"byteLength", bytes.size()}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  return json;
}

TEST(LoadPacked, BuffersInTheFile) {
  std::string bytes(56, '\0');
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint16_t indices[4] = {0, 1, 2, 3};
  std::memcpy(bytes.data(), positions, 48);
  std::memcpy(bytes.data() + 48, indices, 8);
  Json json = with_buffer(bytes);
  json["bufferViews"] = triangle_json()["bufferViews"];
  EXPECT_EQ(load_good(json).mesh->positions[1], glm::vec3(1, 0, 0));
  json["buffers"][0]["byteLength"] = 57;
  EXPECT_NE(error_of(json).find("holds 56 bytes"), std::string::npos);
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
  std::string bytes(20001, '\0');
  for (std::size_t i = 56; i < bytes.size(); ++i) bytes[i] = static_cast<char>(7 * i);
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint16_t indices[4] = {0, 1, 2, 3};
  std::memcpy(bytes.data(), positions, 48);
  std::memcpy(bytes.data() + 48, indices, 8);
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

// A PNG whose header says what it likes.
std::string png_of(std::uint32_t width, std::uint32_t height) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{2, 2, 8, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 0, 0, 0};
  spng_set_ihdr(context.get(), &header);
  const unsigned char pixels[16] = {10, 20, 30, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  spng_encode_image(context.get(), pixels, sizeof pixels, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::size_t size = 0;
  int failure = 0;
  char* bytes = static_cast<char*>(spng_get_png_buffer(context.get(), &size, &failure));
  std::string png(bytes, size);
  free(bytes);
  for (int i = 0; i < 4; ++i) {
    png[16 + static_cast<std::size_t>(i)] = static_cast<char>(width >> (24 - 8 * i));
    png[20 + static_cast<std::size_t>(i)] = static_cast<char>(height >> (24 - 8 * i));
  }
  return png;
}

Json textured_with(const std::string& image) {
  return with_coordinates(textured_json({{"uri", "data:image/png;base64," + base64(image)}}));
}

TEST(LoadPacked, ImagesClaimNoMemoryBeforeTheLimitIsAsked) {
  EXPECT_EQ(load_good(textured_with(png_of(2, 2))).mesh->textures[0].image().at(0, 0),
            glm::u8vec4(10, 20, 30, 255));
  EXPECT_NE(error_of(textured_with(png_of(60000, 60000))).find("60000 x 60000 pixels needs 13733 MiB"),
            std::string::npos);
  EXPECT_NE(error_of(textured_with(png_of(60000, 60000))).find("--load-limit"), std::string::npos);
  std::ofstream(own_file("small.gltf")) << textured_with(png_of(2, 2)).dump();
  EXPECT_FALSE(load_scene(own_file("small.gltf"), nullptr, nullptr, 100));
}

TEST(LoadPacked, DamagedImagesAreWarnings) {
  const std::string whole = png_of(2, 2);
  Random random(5);
  constexpr std::size_t kEnd = 16;  // bytes after the last pixel: a checksum and an empty chunk
  for (std::size_t cut = 0; cut + kEnd < whole.size(); ++cut) {
    std::string bytes = whole.substr(0, cut);
    if (cut > 30) bytes[random.next() % (cut - 30) + 30] ^= 0x40;
    Warnings warnings;
    ASSERT_TRUE(load(textured_with(bytes), &warnings));
    EXPECT_EQ(warnings.size(), 1u) << cut;
  }
}

TEST(LoadPacked, PipesAreRefusedAtOnce) {
  const std::filesystem::path pipe = own_file("pipe.bin");
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Json json = triangle_json();
  json["buffers"][0]["uri"] = pipe.filename().string();
  EXPECT_NE(error_of(json).find("pipe or device"), std::string::npos);
  Warnings warnings;
  EXPECT_TRUE(load(with_coordinates(textured_json({{"uri", pipe.filename().string()}})), &warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("pipe or device"), std::string::npos);
  for (const char* name : {"pipe.obj", "pipe.gltf", "pipe.ply"}) {
    std::filesystem::remove(own_file(name));
    ASSERT_EQ(mkfifo(own_file(name).c_str(), 0600), 0);
    EXPECT_NE(load_scene(own_file(name)).error().message().find("pipe or device"), std::string::npos);
  }
}

TEST(LoadPacked, BinaryFilesThatEndTooEarly) {
  std::ifstream in(source_path("scenes/speedboat.glb"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  std::ofstream(own_file("cut.glb"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(load_scene(own_file("cut.glb")).error().message().find("ends within a chunk"), std::string::npos);
  std::string old = whole;
  old[4] = 1;
  std::ofstream(own_file("old.glb"), std::ios::binary) << old;
  EXPECT_NE(load_scene(own_file("old.glb")).error().message().find("binary glTF 1"), std::string::npos);
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

TEST(LoadPacked, CopiesAreCountedBeforeTheyAreMade) {
  Json json = triangle_json();
  // The zeros of an accessor without a buffer view: nothing of it is in the file.
  json["accessors"].push_back({{"componentType", 5126}, {"count", 20000000}, {"type", "VEC3"}});
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  const std::string instances = error_of(json);
  EXPECT_NE(
      instances.find("placing 20000000 triangles, with 19999999 copies of meshes, needs 14649 MiB of memory"),
      std::string::npos)
      << instances;
  EXPECT_NE(instances.find("--load-limit MIB"), std::string::npos);
  json["accessors"][2]["count"] = 2000000000;
  EXPECT_NE(error_of(json).find("places 2000000000 triangles"), std::string::npos);
  // Nodes that share a mesh.
  Json shared = triangle_json();
  shared["nodes"] = Json::array();
  shared["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 3000; ++i) {
    shared["nodes"].push_back({{"mesh", 0}});
    shared["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_EQ(load_good(shared).mesh->triangles.size(), 3000u);
  const Expected<Scene> refused = load_scene(own_file("test.gltf"), nullptr, nullptr, 1 << 20);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("placing 3000 triangles, with 2999 copies of meshes, needs 3 MiB"),
            std::string::npos)
      << refused.error().message();
}

// 31.2 MB a copy: its triangles have no tree of their own.
TEST(LoadPacked, CopiesThatShareATreeAreCountedAsSuch) {
  Json json = triangle_json();
  for (const int zeros : {300000, 1000})
    json["accessors"].push_back({{"componentType", 5126}, {"count", zeros}, {"type", "VEC3"}});
  json["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", 2}}}}};
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 3;
  const std::string shared = error_of(json);
  EXPECT_NE(shared.find("placing 100000000 triangles, with 999 copies of meshes, needs 29726 MiB of memory"),
            std::string::npos)
      << shared;
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 2}}};
  const std::string morphs = error_of(json);
  EXPECT_NE(morphs.find("with 999 copies of meshes, needs 42683 MiB of memory"), std::string::npos) << morphs;
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

TEST(LoadPacked, ObjectsWithoutTheirMembersAreNamed) {
  Json json = triangle_json();
  json["skins"] = {Json::object()};
  EXPECT_NE(error_of(json).find("/skins/0 lacks its array of joints"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
