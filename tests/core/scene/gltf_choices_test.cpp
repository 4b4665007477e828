// KHR_materials_variants and KHR_node_visibility.
#include "pinocchio/save.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

Json variants_json() {
  Json json = triangle_json();
  json["materials"] = {{{"name", "plain"}}, {{"name", "red"}}, {{"name", "blue"}}};
  json["extensions"]["KHR_materials_variants"]["variants"] = {
      {{"name", "day"}}, {{"name", "night"}}, {{"name", "dusk"}}};
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}},
                                                                   {{"material", 2}, {"variants", {1}}}};
  json["extensionsUsed"] = {"KHR_materials_variants"};
  return json;
}

Expected<Scene> load_variant(const Json& json, const std::string& name, Warnings* warnings = nullptr) {
  const std::filesystem::path path = own_file("test.gltf");
  std::ofstream(path) << json.dump();
  return load_scene(path, {.variant = name}, warnings);
}

std::string material_of(const Json& json, const std::string& variant) {
  const Expected<Scene> scene = load_variant(json, variant);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? scene->mesh->material_of(0).name : "";
}

TEST(Variants, AreChosenByName) {
  const Json json = variants_json();
  EXPECT_EQ(material_of(json, ""), "plain");
  EXPECT_EQ(material_of(json, "day"), "red");
  EXPECT_EQ(material_of(json, "night"), "blue");
  EXPECT_EQ(material_of(json, "dusk"), "plain");  // no mapping: the primitive's own
  EXPECT_EQ(load_good(json).variants, (std::vector<std::string>{"day", "night", "dusk"}));
}

TEST(Variants, GiveNoWarning) {
  Warnings warnings;
  EXPECT_TRUE(load_variant(variants_json(), "day", &warnings));
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
}

TEST(Variants, UnknownNamesAreErrorsThatListThem) {
  const Expected<Scene> scene = load_variant(variants_json(), "noon");
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find(
                "has no variant 'noon' of its materials; choose from 'day', 'night' or 'dusk'"),
            std::string::npos)
      << scene.error().message();
  EXPECT_FALSE(load_variant(triangle_json(), "noon"));
  const auto obj = own_file("test.obj");
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_FALSE(load_scene(obj, LoadOptions{.variant = "noon"}));
}

TEST(Variants, DamagedMappingsAreNoCrash) {
  Json json = variants_json();
  Json& mappings = json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
  mappings = {
      {{"material", 77}, {"variants", {0}}}, {{"material", -1}, {"variants", {1}}}, 3, {{"variants", "x"}}};
  EXPECT_FALSE(load_variant(json, "day"));
  EXPECT_TRUE(load_variant(json, "night"));
  json["extensions"]["KHR_materials_variants"]["variants"] = {3, {{"name", "day"}}, nullptr};
  EXPECT_TRUE(load_variant(json, "day"));
}

TEST(Variants, SavingKeepsWhatIsDrawn) {
  const Expected<Scene> scene = load_variant(variants_json(), "night");
  ASSERT_TRUE(scene);
  const auto path = own_file("saved.gltf");
  save_scene(*scene, path);
  const Expected<Scene> again = load_scene(path);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->mesh->material_of(0).name, "blue");
  EXPECT_TRUE(again->variants.empty());
}

// A node with a light and a camera above one with the mesh, beside another of the same mesh.
Json nodes_json() {
  Json json = triangle_json();
  json["nodes"] = {
      {{"children", {1}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
      {{"mesh", 0}},
      {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  json["scenes"][0]["nodes"] = {0, 2};
  return json;
}

TEST(Visibility, HidesMeshesAndLightsBelowButNoCameras) {
  Json json = nodes_json();
  EXPECT_EQ(load_good(json).mesh->triangles.size(), 2u);
  json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] =
      true;  // does not count below a hidden one
  json["extensionsUsed"] = {"KHR_node_visibility"};
  json["extensionsRequired"] = {"KHR_node_visibility"};
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
  EXPECT_EQ(scene->mesh->triangles.size(), 1u);
  EXPECT_EQ(scene->mesh->bounds().lo.x, 5.0f);
  EXPECT_TRUE(scene->lights.empty());
  EXPECT_EQ(scene->cameras.size(), 1u);
  EXPECT_EQ(scene->nodes->nodes.size(), 3u);  // they are still there to be moved
}

TEST(Visibility, NothingVisibleIsAnError) {
  Json json = triangle_json();
  json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_NE(error_of(json).find("holds no triangles"), std::string::npos);
}

TEST(Visibility, CirclesOfHiddenNodesAreAnErrorAsOthers) {
  Json json = triangle_json();
  json["nodes"] = {{{"children", {1}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
                   {{"children", {0}}}};
  EXPECT_NE(error_of(json).find("twice"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
