// glTF files that are not what they claim: they need memory beyond the limit, name images, chunks and members
// that are not there, or pipes in place of files.
#include <spng.h>
#include <sys/stat.h>

#include <algorithm>

#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

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

TEST(LoadClaims, ImagesClaimNoMemoryBeforeTheLimitIsAsked) {
  EXPECT_EQ(load_good(textured_with(png_of(2, 2))).mesh->textures[0].image().at(0, 0),
            glm::u8vec4(10, 20, 30, 255));
  EXPECT_NE(error_of(textured_with(png_of(60000, 60000))).find("60000 x 60000 pixels needs 13733 MiB"),
            std::string::npos);
  EXPECT_NE(error_of(textured_with(png_of(60000, 60000))).find("--load-limit"), std::string::npos);
  std::ofstream(own_file("small.gltf")) << textured_with(png_of(2, 2)).dump();
  EXPECT_FALSE(load_scene(own_file("small.gltf"), nullptr, nullptr, 100));
}

TEST(LoadClaims, DamagedImagesAreWarnings) {
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

TEST(LoadClaims, PipesAreRefusedAtOnce) {
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

TEST(LoadClaims, BinaryFilesThatEndTooEarly) {
  std::ifstream in(source_path("scenes/speedboat.glb"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  std::ofstream(own_file("cut.glb"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(load_scene(own_file("cut.glb")).error().message().find("ends within a chunk"), std::string::npos);
  std::string old = whole;
  old[4] = 1;
  std::ofstream(own_file("old.glb"), std::ios::binary) << old;
  EXPECT_NE(load_scene(own_file("old.glb")).error().message().find("binary glTF 1"), std::string::npos);
}

TEST(LoadClaims, CopiesAreCountedBeforeTheyAreMade) {
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
TEST(LoadClaims, CopiesThatShareATreeAreCountedAsSuch) {
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

TEST(LoadClaims, ObjectsWithoutTheirMembersAreNamed) {
  Json json = triangle_json();
  json["skins"] = {Json::object()};
  EXPECT_NE(error_of(json).find("/skins/0 lacks its array of joints"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
