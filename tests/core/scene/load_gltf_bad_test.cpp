#include <algorithm>
#include <set>

#include "core/math/finite.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

TEST(LoadGltfBad, BadFilesAreErrorsThatSayWhat) {
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
  EXPECT_NE(error_of(json).find("nowhere.bin"), std::string::npos);
  json = triangle_json();
  json["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_NE(error_of(json).find("KHR_texture_basisu"), std::string::npos);
  json = triangle_json();
  json["scenes"][0]["nodes"] = Json::array();
  EXPECT_NE(error_of(json).find("no triangles"), std::string::npos);
}

TEST(LoadGltfBad, ErrorsOfIndicesSayWhichWhereAndOfHowMany) {
  const auto error_with = [](const char* pointer, const Json& value) {
    Json json = triangle_json();
    json[Json::json_pointer(pointer)] = value;
    return error_of(json);
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(error_with("/meshes/0/primitives/0/attributes/POSITION", 99),
      "mesh 0's primitive 0: names accessor 99, there are 2");
  has(error_with("/meshes/0/primitives/0/indices", 9), "mesh 0's primitive 0: names accessor 9, there are 2");
  has(error_with("/meshes/0/primitives/0/material", 3),
      "mesh 0's primitive 0: names material 3, there are 0");
  has(error_with("/accessors/0/bufferView", 7), "accessor 0 names buffer view 7, there are 2");
  has(error_with("/bufferViews/0/buffer", 5), "accessor 0 lies in buffer 5, there are 1");
}

TEST(LoadGltfBad, NumbersThatAreTakenForNoneAreWarnings) {
  const auto warning_with = [](const char* pointer, const Json& value, bool drawn) {
    Json json = triangle_json();
    json[Json::json_pointer(pointer)] = value;
    Warnings warnings;
    EXPECT_EQ(load(json, &warnings).has_value(), drawn) << pointer;
    return warnings.empty() ? std::string() : warnings.begin()->message();
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(warning_with("/scene", 4, true), "scene: names 4 of scenes, there are 1");
  has(warning_with("/nodes/0/mesh", -5, false), "nodes.0.mesh: names -5 of meshes, there are 1");
  has(warning_with("/meshes/1", {{"primitives", {{{"attributes", {{"POSITION", 6}}}}}}}, true),
      "meshes.1.primitives.0.attributes.POSITION: names 6 of accessors, there are 2; the file cannot be "
      "drawn");
  has(warning_with("/nodes/0/camera", 2, true), "nodes.0.camera: names 2 of cameras, there are 0");
  has(warning_with("/meshes/0/primitives/0/attributes/POSITION", -1, false),
      "meshes.0.primitives.0.attributes.POSITION: names -1 of accessors, there are 2");
  has(warning_with("/meshes/0/primitives/0/indices", -1, true), "indices: names -1 of accessors");
  has(warning_with("/nodes/0/mesh", 0.5, false), "nodes.0.mesh: names 0.5 of meshes, there are 1");
  // Some exporters write indices so.
  EXPECT_EQ(warning_with("/nodes/0/mesh", 0.0, true), "");
  EXPECT_EQ(warning_with("/meshes/0/primitives/0/indices", 1.0, true), "");
}

TEST(LoadGltfBad, NumbersOutOfRangeAreClampedWithAWarning) {
  struct Case {
    const char* pointer;
    Json value;
    std::string message;
  };
  const std::string material = "/materials/0/", allowed = "; the nearest allowed value is used";
  for (const auto& [pointer, value, message] :
       {Case{"pbrMetallicRoughness/metallicFactor", 1e300, "metallicFactor is not between 0 and 1"},
        Case{"pbrMetallicRoughness/roughnessFactor", -0.5, "roughnessFactor is not between 0 and 1"},
        Case{"pbrMetallicRoughness/baseColorFactor",
             {1, -1, 1, 1},
             "baseColorFactor is not between 0 and 1e+06"},
        Case{"emissiveFactor", {0, 0, 1e300}, "emissiveFactor is not between 0 and 1e+06"},
        Case{"extensions/KHR_materials_emissive_strength/emissiveStrength", -5,
             "emissiveStrength is not between 0 and 1e+06"},
        Case{"extensions/KHR_materials_transmission/transmissionFactor", 5,
             "transmissionFactor is not between 0 and 1"},
        Case{"extensions/KHR_materials_ior/ior", -1, "ior is not between 0 and 1e+06"},
        Case{"occlusionTexture", {{"index", 0}, {"strength", 5}}, "strength is not between 0 and 1"},
        Case{"extras/pinocchio/phong/kd", {-1, 0, 0}, "kd is not between 0 and 1e+06"}}) {
    Json json = triangle_json();
    json["meshes"][0]["primitives"][0]["material"] = 0;
    json[Json::json_pointer(material + pointer)] = value;
    Warnings warnings;
    const Expected<Scene> scene = load(json, &warnings);
    ASSERT_TRUE(scene) << pointer;
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [&](const Warning& warning) {
      return warning.message().find("material 0: its " + message + allowed) != std::string::npos;
    })) << pointer;
    const Material& m = scene->mesh->material_of(0);
    for (const glm::vec3& part : {m.diffuse, m.specular, m.emission, m.transmittance}) {
      EXPECT_TRUE(is_finite(part)) << pointer;
      EXPECT_GE(std::min({part.r, part.g, part.b}), 0.0f) << pointer;
    }
    EXPECT_GE(m.ior, 0.0f);
  }
}

TEST(LoadGltfBad, WhatTheFileDoesNotHoldIsNotBelieved) {
  Json json = triangle_json();
  json["accessors"][0] = {{"componentType", 5126},
                          {"count", 4000000000u},
                          {"type", "VEC3"},
                          {"sparse",
                           {{"count", 1},
                            {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                            {"values", {{"bufferView", 0}}}}}};
  EXPECT_NE(error_of(json).find("--load-limit"), std::string::npos);
  json["accessors"][0]["count"] = 4;
  json["accessors"][0]["sparse"]["indices"]["componentType"] = 5126;
  EXPECT_NE(error_of(json).find("unsigned integers"), std::string::npos);
  json = triangle_json();
  json["accessors"][0]["componentType"] = 5124;  // OpenGL's GL_INT
  EXPECT_NE(error_of(json).find("component type 5124"), std::string::npos);
  json = triangle_json();
  json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = -1;
  EXPECT_NE(error_of(json).find("light"), std::string::npos);
  json = triangle_json();
  json["meshes"][0]["primitives"][0]["mode"] = 99;
  EXPECT_NE(error_of(json).find("mode 99"), std::string::npos);
}

TEST(LoadGltfBad, TrianglesOnVerticesThatAreNoFiniteNumbersAreLeftOut) {
  Json json = triangle_json();
  json["meshes"][0]["primitives"][0]["mode"] = 5;  // a strip of two, of which the last vertex is the second's
  json["accessors"][1]["count"] = 4;
  json["nodes"][0]["translation"] = {1, 2, 3};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::fstream bin(own_file("test.bin"), std::ios::binary | std::ios::in | std::ios::out);
  bin.seekp(36);
  bin.write(reinterpret_cast<const char*>(&nan), sizeof nan);
  bin.close();
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(scene->nodes->nodes[0].triangles, 1u);
  EXPECT_EQ(scene->mesh->bounds().lo, glm::vec3(1, 2, 3));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.begin()->message().find("mesh 0: faces on vertices that are no finite numbers"),
            std::string::npos);
}

TEST(LoadGltfBad, DeepNestingIsAnError) {
  std::string text = triangle_json().dump();
  text.pop_back();
  text += R"(,"extras":)" + std::string(200000, '[') + std::string(200000, ']') + "}";
  const std::filesystem::path path = own_file("deep.gltf");
  std::ofstream(path) << text;
  const Expected<Scene> scene = load_scene(path);
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().what.find("nested"), std::string::npos);
}

TEST(LoadGltfBad, ImagesThatCannotBeReadAreWarnings) {
  for (const Json& image : {Json{{"uri", "nowhere.png"}}, Json{{"uri", "data:image/png;base64,AAAA"}},
                            Json{{"bufferView", 0}, {"mimeType", "image/png"}}}) {
    Json json = textured_json(image);
    Warnings warnings;
    const Expected<Scene> scene = load(json, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->maps[0].base_color.texture, -1);
    EXPECT_FALSE(warnings.empty());
  }
}

TEST(LoadGltfBad, CamerasAndLightsThatCannotWorkAreLeftOut) {
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

// A file in which each member that is read is present.
Json full_json() {
  Json json = with_coordinates(textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}}));
  json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  json["textures"] = {
      {{"source", 0}, {"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  json["materials"][0]["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1},
                                                                {"attenuationColor", {1, 0, 0}}};
  json["materials"][0]["extras"]["pinocchio"]["phong"] = {{"kd", 0.5}, {"fresnel", true}};
  json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"texCoord", 0}};
  json["accessors"][1]["sparse"] = {{"count", 1},
                                    {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                    {"values", {{"bufferView", 1}}}};
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  json["meshes"][0]["weights"] = {0.5};
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  json["extensions"] = {
      {"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}}}}}}}},
      {"EXT_lights_image_based",
       {{"lights", {{{"rotation", {0, 0, 0, 1}}, {"specularImages", {{0, 0, 0, 0, 0, 0}}}}}}}}};
  json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  json["skins"] = {{{"joints", {1}}}};
  json["nodes"] = {
      {{"mesh", 0}, {"children", {1, 2}}, {"rotation", {0, 0, 0, 1}}},
      {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
      {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 0}}}}}}}}};
  json["animations"] = {{{"samplers", {{{"input", 3}, {"output", 3}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return json;
}

TEST(LoadGltfBad, EveryMemberOfAnyWrongTypeIsAnErrorOrLeftOut) {
  const Json json = full_json();
  const Expected<Scene> whole = load(json);
  ASSERT_TRUE(whole) << whole.error().message();
  const Json flat = json.flatten();
  std::set<std::string> places;  // of all members, arrays and objects too
  for (const auto& member : flat.items())
    for (std::size_t end = 0; end != std::string::npos;) {
      end = member.key().find('/', end + 1);
      places.insert(member.key().substr(0, end));
    }
  for (const std::string& place : places)
    for (const Json& wrong : {Json(), Json(-7), Json(1e300), Json("text"), Json(true), Json::array({Json()}),
                              Json::object({{"a", 1}}), Json(99)}) {
      Json broken = json;
      broken[Json::json_pointer(place)] = wrong;
      const Expected<Scene> scene = load(broken);  // throws nothing
      EXPECT_TRUE(scene || scene.error().message().find('\n') == std::string::npos) << place;
    }
}

TEST(LoadGltfBad, DamagedFilesNeverCrash) {
  const std::filesystem::path glb = source_path("scenes/speedboat.glb");
  std::ifstream in(glb, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const std::filesystem::path damaged = own_file("damaged.glb");
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
