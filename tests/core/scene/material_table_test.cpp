// The parameters of glTF's materials, and the materials they make.
#include "core/scene/gltf/format/material_table.h"

#include <set>

#include "core/scene/gltf/material_from_surface.h"
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

TEST(MaterialFromSurface, PhongFollowsItsFormula) {
  GltfSurface s;
  s.base_color = {0.5f, 0.6f, 0.7f};
  s.metallic = 0.0f;
  s.roughness = 0.5f;
  const Material plastic = material_from_surface(s, Shading::phong);
  EXPECT_NEAR(plastic.diffuse.x, 0.5f * 0.96f / 3.14159265f, 1e-6f);
  EXPECT_NEAR(plastic.shininess, 0.25f * (2.0f / 0.0625f - 2.0f), 1e-4f);
  EXPECT_NEAR(plastic.specular.x, 0.04f * (plastic.shininess + 2.0f) / (2.0f * 3.14159265f), 1e-5f);
  EXPECT_FALSE(plastic.reflects());  // too rough for a mirror
  s.metallic = 1.0f;
  s.roughness = 0.1f;
  const Material metal = material_from_surface(s, Shading::phong);
  EXPECT_EQ(metal.diffuse, glm::vec3(0.0f));
  EXPECT_NEAR(metal.reflectance.y, 0.6f * 0.36f, 1e-5f);
  EXPECT_TRUE(metal.fresnel);
  EXPECT_FALSE(metal.is_microfacet());
}

// glTF 2.0, appendix B, with KHR_materials_specular and _ior.
TEST(MaterialFromSurface, GltfsModelHasItsParameters) {
  GltfSurface s;
  s.base_color = {0.5f, 0.6f, 0.7f};
  s.metallic = 0.25f;
  s.roughness = 0.5f;
  s.specular = 0.5f;
  const Material m = material_from_surface(s, Shading::from_file);
  EXPECT_TRUE(m.is_microfacet());
  EXPECT_FLOAT_EQ(m.ggx_alpha, 0.25f);
  EXPECT_FLOAT_EQ(m.diffuse.x, 0.5f * 0.75f / 3.14159265f);
  EXPECT_FLOAT_EQ(m.layer.x, 0.02f);
  EXPECT_FLOAT_EQ(m.layer.y, 0.5f);
  EXPECT_FLOAT_EQ(m.specular.z, 0.75f * 0.02f + 0.25f * 0.7f);
  EXPECT_FLOAT_EQ(m.grazing, 0.75f * 0.5f + 0.25f);
  EXPECT_TRUE(m.brdf);
}

// On glass, layers are left out.
TEST(MaterialFromSurface, GlassHasNoLayers) {
  const Material glass = material_from_surface(
      {.metallic = 0.0f, .transmission = 1.0f, .layers = {.coat = 1.0f, .sheen = glm::vec3(1.0f)}},
      Shading::from_file);
  EXPECT_FALSE(glass.layers.any());
}

// Saving writes the surface that a material came from.
TEST(MaterialFromSurface, TheSurfaceComesBack) {
  std::vector<GltfSurface> surfaces(8);
  surfaces[0] = {.base_color = {0.5f, 0.6f, 0.1f}, .metallic = 0.25f, .roughness = 0.5f};
  surfaces[1] = {.base_color = {0.9f, 0.6f, 0.1f}, .metallic = 1.0f, .roughness = 0.1f};
  surfaces[2] = {.base_color = glm::vec3(1.0f), .metallic = 0.0f, .roughness = 1.0f, .specular = 0.5f};
  surfaces[3] = {.base_color = glm::vec3(0.0f), .metallic = 0.0f, .roughness = 0.7f};
  surfaces[4] = {.base_color = glm::vec3(0.4f),
                 .metallic = 0.0f,
                 .roughness = 0.2f,
                 .ior = 1.7f,
                 .transmission = 0.5f,
                 .volume = true};
  surfaces[5] = {.base_color = glm::vec3(0.4f), .metallic = 0.0f, .roughness = 0.2f, .transmission = 1.0f};
  surfaces[6] = {.base_color = {0.2f, 0.3f, 0.4f}, .metallic = 0.5f, .specular_color = {0.2f, 1.0f, 0.5f}};
  surfaces[7] = {
      .base_color = {0.2f, 0.3f, 0.4f},
      .metallic = 0.0f,
      .roughness = 0.3f,
      .layers = {.coat = 0.5f, .coat_roughness = 0.2f, .sheen = {0.1f, 0.2f, 0.3f}, .sheen_roughness = 0.6f}};
  for (const GltfSurface& s : surfaces) {
    const GltfSurface back = surface_of_material(material_from_surface(s, Shading::from_file));
    EXPECT_EQ(back.layers, s.layers);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(back.base_color[c], s.base_color[c], 1e-5f);
      EXPECT_NEAR(back.specular_color[c], s.specular_color[c], 1e-4f);
    }
    EXPECT_NEAR(back.metallic, s.metallic, 1e-5f);
    EXPECT_NEAR(back.roughness, s.roughness, 1e-5f);
    EXPECT_NEAR(back.transmission, s.transmission, 1e-5f);
    EXPECT_NEAR(back.specular, s.specular, 1e-5f);
    EXPECT_NEAR(back.ior, s.ior, 1e-5f);
    EXPECT_EQ(back.volume, s.volume);
  }
}

}  // namespace
}  // namespace pinocchio
