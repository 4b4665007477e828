#include "core/scene/gltf/format/material_table.h"

#include <set>

#include "pinocchio/save.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

// These bindings fail to compile where a member is added: give it a row, or name it with those that have code
// of their own, then count it here.
// name, emission, maps, double_sided; of glTF's model ggx_alpha, grazing, layer, layers
constexpr std::size_t kOwnCodeOfMaterial = 8;
constexpr std::size_t kOwnCodeOfSurface = 4;  // base_color, emissive, volume, unlit

std::size_t members_of_material() {
  const Material material;
  [[maybe_unused]] const auto& [m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17,
                                m18, m19, m20] = material;
  return 20;
}

// With those of its layers.
std::size_t members_of_surface() {
  const GltfSurface surface;
  [[maybe_unused]] const auto& [m1, m2, m3, m4, m5, m6, m7, m8, layers, m9, m10] = surface;
  [[maybe_unused]] const auto& [l1, l2, l3, l4] = layers;
  return 10 + 4;
}

TEST(MaterialTable, EveryMemberHasARowOrCodeOfItsOwn) {
  EXPECT_EQ(std::size(kPhongParameters) + std::size(kVolumeParameters) + kOwnCodeOfMaterial,
            members_of_material());
  EXPECT_EQ(std::size(kSurfaceParameters) + kOwnCodeOfSurface, members_of_surface());
  // Alpha is the base colour's fourth channel.
  EXPECT_EQ(std::size(kGltfTextures) + 1, MaterialMaps().uses().size());
}

TEST(MaterialTable, RowsNameDifferentMembers) {
  std::set<std::string> pointers;
  const auto add = [&](const auto& table) {
    for (const auto& row : table) EXPECT_TRUE(pointers.insert(row.at).second) << row.at;
  };
  add(kPhongParameters);
  add(kSurfaceParameters);
  add(kVolumeParameters);
  add(kGltfTextures);
}

// A value, 0 to 1, that no parameter has by default and no two rows share.
Json unusual(const GltfParameter& row, std::size_t index) {
  const float value = 0.25f + static_cast<float>(index) / 64.0f;
  return std::visit(
      [value]<class T, class C>(T C::*) -> Json {
        if constexpr (std::is_same_v<T, bool>) return true;
        if constexpr (std::is_same_v<T, glm::vec3>) return {value, 0.5f, 0.75f};
        return value;
      },
      row.member);
}

Json with_parameters(std::span<const GltfParameter> rows, Json material) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    material[Json::json_pointer(rows[i].at)] = unusual(rows[i], i);
  Json json = triangle_json();
  json["materials"] = {material};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  return json;
}

// Reads the file, saves it, and expects that what is saved names the same values.
void expect_kept(const Json& json, std::span<const GltfParameter> rows) {
  const Scene scene = load_good(json);
  const std::filesystem::path saved = own_file("saved.gltf");
  save_scene(scene, saved);
  Json again;
  std::ifstream(saved) >> again;
  for (const GltfParameter& row : rows) {
    const Json::json_pointer at(row.at);
    ASSERT_TRUE(again["materials"][0].contains(at)) << row.at;
    EXPECT_EQ(again["materials"][0][at], json["materials"][0][at]) << row.at;
  }
  const Expected<Scene> reread = load_scene(saved);
  ASSERT_TRUE(reread) << reread.error().message();
  EXPECT_EQ(reread->mesh->materials, scene.mesh->materials);
  EXPECT_EQ(reread->mesh->maps, scene.mesh->maps);
}

TEST(MaterialTable, PhongIsReadAndWrittenBack) {
  expect_kept(with_parameters(kPhongParameters, Json::object()), kPhongParameters);
}

TEST(MaterialTable, SurfacesAreReadAndWrittenBack) {
  // MASK: the material has maps, which keep the surface.
  expect_kept(with_parameters(kSurfaceParameters, {{"alphaMode", "MASK"}}), kSurfaceParameters);
}

TEST(MaterialTable, VolumesAreReadAndWrittenBack) {
  const Json glass = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
                      {"extensions",
                       {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                        {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}};
  expect_kept(with_parameters(kVolumeParameters, glass), kVolumeParameters);
}

TEST(MaterialTable, TexturesAreReadAndWrittenBack) {
  for (const GltfTexture& row : kGltfTextures) {
    Json json = with_coordinates(textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}}));
    Json& material = json["materials"][0] = Json::object();
    material[Json::json_pointer(row.at)] = {{"index", 0}};
    if (row.factor) material[Json::json_pointer(row.at)][row.factor] = 0.375f;
    const Scene scene = load_good(json);
    ASSERT_EQ(scene.mesh->maps.size(), 1u) << row.at;
    EXPECT_TRUE((scene.mesh->maps[0].*row.use).used()) << row.at;
    if (row.factor) {
      EXPECT_EQ(scene.mesh->maps[0].*row.factor_value, 0.375f) << row.at;
    }
    save_scene(scene, own_file("saved.gltf"));
    const Expected<Scene> again = load_scene(own_file("saved.gltf"));
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->mesh->maps, scene.mesh->maps) << row.at;
  }
}

TEST(MaterialTable, ValuesOfTheWrongTypeAreWarnings) {
  const auto expect_warnings = [](std::span<const GltfParameter> rows) {
    for (const GltfParameter& row : rows) {
      Json json = with_parameters({}, Json::object());
      json["materials"][0][Json::json_pointer(row.at)] = "text";
      Warnings warnings;
      EXPECT_TRUE(load(json, &warnings)) << row.at;
      ASSERT_EQ(warnings.size(), 1u) << row.at;
      EXPECT_NE(warnings.begin()->message().find("has the wrong type"), std::string::npos) << row.at;
    }
  };
  expect_warnings(kPhongParameters);
  expect_warnings(kSurfaceParameters);
  expect_warnings(kVolumeParameters);
}

TEST(MaterialTable, ItsExtensionsAreRead) {
  for (const GltfParameter& row : kSurfaceParameters) {
    const std::string extension(gltf_extension_of(row.at));
    if (extension.empty()) continue;
    Json json = triangle_json();
    json["extensionsRequired"] = {extension};
    EXPECT_TRUE(load(json)) << extension;
  }
}

}  // namespace
}  // namespace pinocchio
