// Nothing of a file is lost in silence: one warning for each feature and file.
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

std::string line_about(const Warnings& warnings, const std::string& text) {
  for (const Warning& w : warnings)
    if (w.message().find(text) != std::string::npos) return w.message();
  return "";
}

Warnings warnings_of(const Json& json) {
  Warnings warnings;
  (void)load(json, &warnings);
  return warnings;
}

Json with_material(const Json& material) {
  Json json = triangle_json();
  json["materials"] = {material};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  return json;
}

TEST(LoadLost, OneWarningForEachFeatureAndFile) {
  Warnings warnings;
  for (const char* where : {"line 1", "line 2", "line 5"})
    warnings.add({"a.obj", where, "lines are left out", "x"});
  warnings.add({"a.obj", "line 3", "points are left out", "y"});
  warnings.add({"b.obj", "line 4", "lines are left out", "x"});
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0].message(), "a.obj: line 1: lines are left out (and in 2 more places); x");
}

TEST(LoadLost, WhatIsReadIsNotWarnedOf) {
  EXPECT_TRUE(warnings_of(triangle_json()).empty());
  EXPECT_TRUE(warnings_of(with_material({{"doubleSided", true},
                                         {"extensions", {{"KHR_materials_ior", {{"ior", 1.4}}}}}}))
                  .empty());
}

TEST(LoadLost, ExtensionsByName) {
  const Json json = with_material(
      {{"name", "paint"}, {"extensions", {{"KHR_materials_iridescence", Json::object()}, {"ACME_new", 1}}}});
  const Warnings warnings = warnings_of(json);
  EXPECT_NE(line_about(warnings, "KHR_materials_iridescence").find("material 'paint'"), std::string::npos);
  EXPECT_NE(line_about(warnings, "KHR_materials_iridescence").find("thin films are missing"),
            std::string::npos);
  EXPECT_NE(line_about(warnings, "ACME_new"), "");
  EXPECT_EQ(warnings.size(), 2u);
}

TEST(LoadLost, MaterialsThatNothingUsesAreNotMissed) {
  Json json = triangle_json();
  json["materials"] = {{{"extensions", {{"KHR_materials_iridescence", Json::object()}}}}};
  EXPECT_TRUE(warnings_of(json).empty());
}

// With a texture that lies as texture coordinates say.
Json covered_json() {
  return with_coordinates(textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}}));
}

TEST(LoadLost, TexturesWithoutCoordinates) {
  Json json = covered_json();
  Json& texture = json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  const std::string warning = "its baseColorTexture lies on triangles without texture coordinates";
  texture["texCoord"] = 1;
  EXPECT_NE(line_about(warnings_of(json), warning), "");
  texture["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
  EXPECT_EQ(line_about(warnings_of(json), warning), "");
  json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  EXPECT_NE(line_about(warnings_of(json), warning), "");
}

// Values that glTF does not allow; the default that is drawn instead is not meant.
TEST(LoadLost, MembersOfTheWrongType) {
  Json json = covered_json();
  EXPECT_TRUE(warnings_of(json).empty());
  Json& texture = json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  for (const Json& index : {Json(-1), Json(1), Json("0"), Json()}) {
    texture["index"] = index;
    EXPECT_NE(line_about(warnings_of(json), "its baseColorTexture names an image that does not exist"), "")
        << index;
  }
  texture["index"] = 0;
  texture["extensions"]["KHR_texture_transform"] = "turned";
  EXPECT_NE(line_about(warnings_of(json), "baseColorTexture's KHR_texture_transform is not an object"), "");
  for (const Json& material :
       {Json{{"pbrMetallicRoughness", Json::array()}},
        Json{{"pbrMetallicRoughness", {{"metallicFactor", "0"}}}},
        Json{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}}, Json{{"alphaMode", "mask"}},
        Json{{"doubleSided", 1}}, Json{{"emissiveFactor", {1, 1, "1"}}}})
    EXPECT_NE(line_about(warnings_of(with_material(material)), "has the wrong type"), "") << material;
}

TEST(LoadLost, SkinsWithoutJointsAndOtherScenes) {
  Json json = triangle_json();
  json["skins"] = {{{"joints", {0}}}};
  json["nodes"][0]["skin"] = 0;
  json["scenes"].push_back({{"name", "other"}});
  const Warnings warnings = warnings_of(json);
  EXPECT_NE(line_about(warnings, "skin"), "");
  EXPECT_NE(line_about(warnings, "scene 'other'"), "");
}

TEST(LoadLost, PointsAndLinesWhereTheyAreAllThereIsAreTheErrorsOnlyLine) {
  Json json = triangle_json();
  json["meshes"][0]["primitives"][0]["mode"] = 1;
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find("only lines; draw them with --line-width D"), std::string::npos)
      << scene.error().message();
  const auto obj = own_file("lines.obj");
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n";
  const Expected<Scene> both = load_scene(obj, &warnings);
  ASSERT_FALSE(both);
  EXPECT_NE(
      both.error().message().find("only points and lines; draw them with --point-size D and --line-width D"),
      std::string::npos)
      << both.error().message();
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
}

TEST(LoadLost, PointsAndLinesBesideTriangles) {
  Json json = triangle_json();
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  const std::string points = line_about(warnings_of(json), "points are left out");
  EXPECT_NE(points.find("mesh 0"), std::string::npos) << points;
  EXPECT_NE(points.find("--point-size draws them"), std::string::npos) << points;
  const auto obj = own_file("lines.obj");
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\n";
  Warnings warnings;
  EXPECT_TRUE(load_scene(obj, &warnings));
  const std::string lines = line_about(warnings, "lines are left out");
  EXPECT_NE(lines.find("line 5"), std::string::npos) << lines;
  EXPECT_NE(lines.find("1 more place"), std::string::npos) << lines;
}

TEST(LoadLost, NodeTransformsWithTheWrongCountOfNumbers) {
  Json json = triangle_json();
  json["nodes"][0]["translation"] = {1, 2};
  const std::string line = line_about(warnings_of(json), "translation is left out");
  EXPECT_NE(line.find("node 0: its translation is left out, as it is not 3 numbers"), std::string::npos)
      << line;
  json = triangle_json();
  json["nodes"][0]["matrix"] = std::vector<int>(15, 1);
  EXPECT_NE(line_about(warnings_of(json), "matrix is left out"), "");
}

TEST(LoadLost, VersionAndRequiredExtensionsBeforeAnythingElse) {
  Json json = triangle_json();
  json["asset"]["version"] = "1.0";
  json["buffers"] = {{"binary_glTF", {{"byteLength", 0}}}};  // as 1.0 has it
  EXPECT_NE(error_of(json).find("is glTF 1.0"), std::string::npos);
  for (const char* name : {"KHR_texture_basisu", "MSFT_texture_dds", "KHR_materials_iridescence"}) {
    json = triangle_json();
    json["extensionsRequired"] = {name};
    json["buffers"][0]["uri"] = "nowhere.bin";
    EXPECT_NE(error_of(json).find(std::string("requires the extension ") + name), std::string::npos);
  }
}

TEST(LoadLost, StatementsOfMtlAndObj) {
  std::ofstream(own_file("lost.mtl"))
      << "newmtl m\nKd 1 0 0\nPc 1\nfoo 3\nbar 4\nd 0.5\nmap_Kd -zz 1 on a.png\n";
  const auto obj = own_file("lost.obj");
  std::ofstream(obj)
      << "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\ncurv 0 1 1 2\nmagic\nf 1 2 3\n";
  Warnings warnings;
  ASSERT_TRUE(load_scene(obj, &warnings));
  EXPECT_NE(line_about(warnings, "lost.mtl: line 3: Pc"), "");
  EXPECT_NE(line_about(warnings, "(foo)").find("1 more"), std::string::npos);
  EXPECT_NE(line_about(warnings, "option -zz"), "");
  EXPECT_NE(line_about(warnings, "free-form"), "");
  EXPECT_NE(line_about(warnings, "(magic)"), "");
}

// Else the surface turns black in silence.
TEST(LoadLost, ValuesOfMtlThatAreNoNumbers) {
  std::ofstream(own_file("words.mtl")) << "newmtl m\nKd oops\nKs\nNs 10\nd -halo 1\n";
  const auto obj = own_file("words.obj");
  std::ofstream(obj) << "mtllib words.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  Warnings warnings;
  ASSERT_TRUE(load_scene(obj, &warnings));
  EXPECT_NE(line_about(warnings, "words.mtl: line 2: Kd 'oops' is no number"), "");
  EXPECT_NE(line_about(warnings, "words.mtl: line 3: Ks '' is no number"), "");
  EXPECT_EQ(warnings.size(), 2u);
}

TEST(LoadLost, ObjFacesWithoutArea) {
  const std::filesystem::path path = own_file("thin.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 3\n";
  Warnings warnings;
  const Expected<Scene> scene = load_scene(path, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("line 4 (f): faces of fewer than three corners are left out"),
            std::string::npos)
      << warnings[0].message();
}

}  // namespace
}  // namespace pinocchio
