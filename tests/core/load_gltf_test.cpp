#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/scene/phong_from_gltf.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// A glTF of one triangle (0,0,0) (1,0,0) (0,1,0), its buffer in a file beside it.
Json triangle_json() {
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<std::uint16_t> indices{0, 1, 2, 3};
  std::ofstream out(std::filesystem::path(testing::TempDir()) / "test.bin", std::ios::binary);
  out.write(reinterpret_cast<const char*>(positions.data()), 48);
  out.write(reinterpret_cast<const char*>(indices.data()), 8);
  return Json::parse(R"({
    "asset": {"version": "2.0"},
    "buffers": [{"uri": "test.bin", "byteLength": 56}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
    "scene": 0
  })");
}

Expected<Scene> load(const Json& json, Warnings* warnings = nullptr) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "test.gltf";
  std::ofstream(path) << json.dump();
  return load_scene(path, warnings);
}

Scene load_good(const Json& json) {
  Expected<Scene> scene = load(json);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? std::move(*scene) : Scene{};
}

std::string error_of(const Json& json) {
  const Expected<Scene> scene = load(json);
  EXPECT_FALSE(scene);
  return scene ? "" : scene.error().message();
}

TEST(LoadGltf, ReadsATriangle) {
  const Scene scene = load_good(triangle_json());
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.positions[scene.triangles[0].y], glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.material_of(0).name, "default");
}

TEST(LoadGltf, StripsAndFans) {
  Json json = triangle_json();
  json["accessors"][1]["count"] = 4;
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_EQ(load_good(json).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}}));
  json["meshes"][0]["primitives"][0]["mode"] = 6;
  EXPECT_EQ(load_good(json).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(LoadGltf, NodeTransformsAreChained) {
  Json json = triangle_json();
  json["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 5}}},
                   {{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}, {"scale", {2, 2, 2}}}};
  const Scene scene = load_good(json);
  const glm::vec3 p = scene.positions[1];  // (1,0,0) twice as long, turned to +y, moved
  EXPECT_NEAR(p.x, 0.0f, 1e-6f);
  EXPECT_NEAR(p.y, 2.0f, 1e-6f);
  EXPECT_NEAR(p.z, 5.0f, 1e-6f);
}

TEST(LoadGltf, MirroringTransformsTurnTrianglesAround) {
  Json json = triangle_json();
  json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(load_good(json).triangles[0], glm::uvec3(0, 2, 1));
}

TEST(LoadGltf, LightsWithOurExtras) {
  Json json = triangle_json();
  json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"},
       {"intensity", 7},
       {"name", "lamp"},
       {"extras", {{"pinocchio", {{"castsShadow", false}}}}}},
      {{"type", "directional"}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"},
       {"range", 9},
       {"spot", {{"outerConeAngle", 0.5}}},
       {"extras", {{"pinocchio", {{"falloff", "none"}}}}}}};
  json["nodes"] = {{{"mesh", 0}},
                   {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                   {{"rotation", {-0.70710678, 0, 0, 0.70710678}},
                    {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}},
                   {{"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}}};
  json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Scene scene = load_good(json);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].intensity, 7.0f);
  EXPECT_FALSE(scene.lights[0].casts_shadow);
  EXPECT_EQ(scene.lights[0].falloff, Light::Falloff::inverse_square);
  EXPECT_EQ(scene.lights[1].kind, Light::Kind::directional);
  EXPECT_NEAR(scene.lights[1].direction.y, -1.0f, 1e-6f);
  EXPECT_TRUE(scene.lights[1].casts_shadow);
  EXPECT_EQ(scene.lights[2].kind, Light::Kind::spot);
  EXPECT_EQ(scene.lights[2].falloff, Light::Falloff::none);
  EXPECT_EQ(scene.lights[2].range, 9.0f);
  EXPECT_NEAR(scene.lights[2].cos_outer, std::cos(0.5f), 1e-6f);
}

TEST(LoadGltf, Cameras) {
  Json json = triangle_json();
  json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}}};
  json["nodes"] = {
      {{"mesh", 0}}, {{"camera", 0}, {"name", "eye"}, {"translation", {0, 0, 4}}}, {{"camera", 1}}};
  json["scenes"][0]["nodes"] = {0, 1, 2};
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->cameras.size(), 1u);
  EXPECT_EQ(scene->cameras[0].name, "eye");
  EXPECT_EQ(scene->cameras[0].eye, glm::vec3(0, 0, 4));
  EXPECT_EQ(scene->cameras[0].target, glm::vec3(0, 0, 3));
  EXPECT_NEAR(scene->cameras[0].fov_deg, 57.29578f, 1e-4f);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadGltf, PhongExtrasAndExtensions) {
  Json json = triangle_json();
  json["materials"] = {{{"name", "ours"},
                        {"extras",
                         {{"pinocchio",
                           {{"phong",
                             {{"kd", {0.1, 0.2, 0.3}},
                              {"ks", 0.5},
                              {"shininess", 30},
                              {"reflect", 0.25},
                              {"transmit", 0.75},
                              {"ior", 1.33}}}}}}}},
                       {{"name", "glow"},
                        {"emissiveFactor", {1, 0.5, 0}},
                        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}},
                       {{"name", "glass"},
                        {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
                        {"extensions",
                         {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                          {"KHR_materials_volume", {{"thicknessFactor", 1}}},
                          {"KHR_materials_ior", {{"ior", 1.4}}}}}},
                       {{"name", "film"},
                        {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                        {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}},
                       {{"name", "unlit"},
                        {"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 1}}}},
                        {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
  const Scene scene = load_good(json);
  EXPECT_EQ(scene.materials[0].diffuse, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.materials[0].specular, glm::vec3(0.5f));
  EXPECT_EQ(scene.materials[0].shininess, 30.0f);
  EXPECT_EQ(scene.materials[0].reflectance, glm::vec3(0.25f));
  EXPECT_EQ(scene.materials[0].transmittance, glm::vec3(0.75f));
  EXPECT_EQ(scene.materials[0].ior, 1.33f);
  EXPECT_EQ(scene.materials[1].emission, glm::vec3(4, 2, 0));
  EXPECT_EQ(scene.materials[2].ior, 1.4f);
  EXPECT_TRUE(scene.materials[2].transmits());
  EXPECT_EQ(scene.materials[3].ior, 1.0f);  // infinitely thin: straight through
  EXPECT_EQ(scene.materials[4].emission, glm::vec3(0.2f, 0.4f, 0.6f));
  EXPECT_EQ(scene.materials[4].diffuse, glm::vec3(0.0f));
}

TEST(PhongFromGltf, FollowsItsFormula) {
  GltfSurface s;
  s.base_color = {0.5f, 0.6f, 0.7f};
  s.metallic = 0.0f;
  s.roughness = 0.5f;
  const Material plastic = phong_from_gltf(s);
  EXPECT_NEAR(plastic.diffuse.x, 0.5f * 0.96f / 3.14159265f, 1e-6f);
  EXPECT_NEAR(plastic.shininess, 0.25f * (2.0f / 0.0625f - 2.0f), 1e-4f);
  EXPECT_NEAR(plastic.specular.x, 0.04f * (plastic.shininess + 2.0f) / (2.0f * 3.14159265f), 1e-5f);
  EXPECT_FALSE(plastic.reflects());  // too rough for a mirror
  s.metallic = 1.0f;
  s.roughness = 0.1f;
  const Material metal = phong_from_gltf(s);
  EXPECT_EQ(metal.diffuse, glm::vec3(0.0f));
  EXPECT_NEAR(metal.reflectance.y, 0.6f * 0.36f, 1e-5f);
  EXPECT_TRUE(metal.fresnel);
}

TEST(LoadGltf, BadFilesAreErrorsThatSayWhat) {
  Json json = triangle_json();
  json["accessors"][0]["count"] = 400;
  EXPECT_NE(error_of(json).find("accessor 0 reaches beyond its buffer"), std::string::npos);
  json = triangle_json();
  json["accessors"][0]["bufferView"] = 7;
  EXPECT_NE(error_of(json).find("buffer view"), std::string::npos);
  json = triangle_json();
  json["accessors"][0]["type"] = "VEC2";
  EXPECT_NE(error_of(json).find("3 numbers"), std::string::npos);
  json = triangle_json();
  json["accessors"][0]["count"] = 2;  // the index 2 is out of range now
  EXPECT_NE(error_of(json).find("names vertex 2"), std::string::npos);
  json = triangle_json();
  json["meshes"][0]["primitives"][0]["material"] = 3;
  EXPECT_NE(error_of(json).find("material 3"), std::string::npos);
  json = triangle_json();
  json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
  EXPECT_NE(error_of(json).find("twice"), std::string::npos);
  json = triangle_json();
  json["nodes"][0]["mesh"] = 4;
  EXPECT_NE(error_of(json).find("mesh 4"), std::string::npos);
  json = triangle_json();
  json["buffers"][0]["uri"] = "nowhere.bin";
  EXPECT_NE(error_of(json).find("glTF"), std::string::npos);
  json = triangle_json();
  json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_NE(error_of(json).find("KHR_draco_mesh_compression"), std::string::npos);
  json = triangle_json();
  json["scenes"][0]["nodes"] = Json::array();
  EXPECT_NE(error_of(json).find("no triangles"), std::string::npos);
}

TEST(LoadGltf, WhatTheFileDoesNotHoldIsNotBelieved) {
  Json json = triangle_json();
  json["accessors"][0] = {{"componentType", 5126},
                          {"count", 4000000000u},
                          {"type", "VEC3"},
                          {"sparse",
                           {{"count", 1},
                            {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                            {"values", {{"bufferView", 0}}}}}};
  EXPECT_NE(error_of(json).find("not in the file"), std::string::npos);
  json["accessors"][0]["count"] = 4;
  json["accessors"][0]["sparse"]["indices"]["componentType"] = 5126;
  EXPECT_NE(error_of(json).find("unsigned integers"), std::string::npos);
  json = triangle_json();
  json["accessors"][0]["componentType"] = 5124;  // tinygltf's INT
  EXPECT_NE(error_of(json).find("component type 5124"), std::string::npos);
  json = triangle_json();
  json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = -1;
  EXPECT_NE(error_of(json).find("light"), std::string::npos);
  json = triangle_json();
  json["meshes"][0]["primitives"][0]["mode"] = 99;
  EXPECT_NE(error_of(json).find("mode 99"), std::string::npos);
}

TEST(LoadGltf, SparseAccessorsAreFilledIn) {
  Json json = triangle_json();
  json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"byteOffset", 2}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}, {"byteOffset", 36}}}};
  EXPECT_EQ(load_good(json).positions[1], glm::vec3(1, 1, 0));  // the fourth's place in the second
}

TEST(LoadGltf, DeepNestingIsAnError) {
  std::string text = triangle_json().dump();
  text.pop_back();
  text += R"(,"extras":)" + std::string(200000, '[') + std::string(200000, ']') + "}";
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "deep.gltf";
  std::ofstream(path) << text;
  const Expected<Scene> scene = load_scene(path);
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().what.find("nested"), std::string::npos);
}

// A material whose base colour is image 0 of the file.
Json textured_json(const Json& image) {
  Json json = triangle_json();
  json["images"] = {image};
  json["textures"] = {{{"source", 0}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  return json;
}

TEST(LoadGltf, ImagesBesideTheFileAreTextures) {
  std::ofstream(std::filesystem::path(testing::TempDir()) / "texel.ppm", std::ios::binary)
      << "P6 1 1 255\n\x0a\x14\x1e";
  const Scene scene = load_good(textured_json({{"uri", "texel.ppm"}}));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials[0].diffuse_texture, 0);
  EXPECT_EQ(scene.textures[0].texels.at(0, 0), glm::u8vec4(10, 20, 30, 255));
}

TEST(LoadGltf, ImagesThatCannotBeReadAreWarnings) {
  for (const Json& image : {Json{{"uri", "nowhere.png"}}, Json{{"uri", "data:image/png;base64,AAAA"}},
                            Json{{"bufferView", 0}, {"mimeType", "image/png"}}}) {
    Json json = textured_json(image);
    Warnings warnings;
    const Expected<Scene> scene = load(json, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->materials[0].diffuse_texture, -1);
    EXPECT_FALSE(warnings.empty());
  }
}

TEST(LoadGltf, CamerasAndLightsThatCannotWorkAreLeftOut) {
  Json json = triangle_json();
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.0}, {"znear", 0.1}}}},
                     {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1e300}}};
  json["nodes"] = {{{"mesh", 0}},
                   {{"camera", 0}},
                   {{"camera", 1}, {"extras", {{"pinocchio", {{"target", 0}, {"up", 0}}}}}},
                   {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
  json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(scene->lights.empty());
  ASSERT_EQ(scene->cameras.size(), 1u);
  EXPECT_EQ(scene->cameras[0].target, glm::vec3(0, 0, -1));  // the one in the file is the eye itself
  EXPECT_EQ(scene->cameras[0].up, glm::vec3(0, 1, 0));
}

TEST(LoadGltf, DamagedFilesNeverCrash) {
  const std::filesystem::path glb = source_path("scenes/speedboat.glb");
  std::ifstream in(glb, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const std::filesystem::path damaged = std::filesystem::path(testing::TempDir()) / "damaged.glb";
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    if (i % 3 == 0) bytes.resize(random.next() % bytes.size());
    // Mostly in the JSON, which is what is interpreted.
    for (int k = 0; k < 20; ++k)
      bytes[random.next() % std::min<std::size_t>(bytes.size(), 20000)] ^=
          static_cast<char>(1u << random.next() % 8);
    std::ofstream(damaged, std::ios::binary) << bytes;
    (void)load_scene(damaged);
  }
}

}  // namespace
}  // namespace pinocchio
