#include "pinocchio/save.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

TEST(LoadGltf, ReadsATriangle) {
  const Scene scene = load_good(triangle_json());
  ASSERT_EQ(scene.mesh->triangles.size(), 1u);
  EXPECT_EQ(scene.mesh->positions[scene.mesh->triangles[0].y], glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.mesh->material_of(0).name, "default");
}

// glTF 2.0, "Default Material": white, metallic 1, roughness 1.
TEST(LoadGltf, APrimitiveWithoutMaterialHasTheEmptyOne) {
  Json bare = triangle_json();
  for (const bool colored : {false, true}) {
    if (colored) {
      bare["accessors"].push_back(
          {{"bufferView", 0}, {"componentType", 5121}, {"normalized", true}, {"count", 4}, {"type", "VEC4"}});
      bare["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
    }
    Json empty = bare;
    empty["materials"] = {{{"name", "default"}}};
    empty["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene a = load_good(bare), b = load_good(empty);
    EXPECT_EQ(a.mesh->material_of(0), b.mesh->material_of(0));
    EXPECT_EQ(a.mesh->materials.size(), 1u);
    EXPECT_EQ(a.mesh->maps, b.mesh->maps);
  }
}

TEST(LoadGltf, StripsAndFans) {
  Json json = triangle_json();
  json["accessors"][1]["count"] = 4;
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_EQ(load_good(json).mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}}));
  json["meshes"][0]["primitives"][0]["mode"] = 6;
  EXPECT_EQ(load_good(json).mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(LoadGltf, NodeTransformsAreChained) {
  Json json = triangle_json();
  json["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 5}}},
                   {{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}, {"scale", {2, 2, 2}}}};
  const Scene scene = load_good(json);
  const glm::vec3 p = scene.mesh->positions[1];  // (1,0,0) twice as long, turned to +y, moved
  EXPECT_NEAR(p.x, 0.0f, 1e-6f);
  EXPECT_NEAR(p.y, 2.0f, 1e-6f);
  EXPECT_NEAR(p.z, 5.0f, 1e-6f);
}

TEST(LoadGltf, MirroringTransformsTurnTrianglesAround) {
  Json json = triangle_json();
  json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(load_good(json).mesh->triangles[0], glm::uvec3(0, 2, 1));
}

// What glTF's own materials do not say is its default; ours say nothing unless it is there.
TEST(LoadGltf, MaterialsSayWhetherTheyAreDoubleSided) {
  Json json = triangle_json();
  const Json phong{{"pinocchio", {{"phong", {{"kd", 0.5}}}}}};
  json["materials"] = {Json::object(),
                       {{"doubleSided", true}},
                       {{"doubleSided", false}},
                       {{"extras", phong}},
                       {{"extras", phong}, {"doubleSided", true}},
                       {{"extras", phong}, {"doubleSided", false}}};
  const std::vector<std::optional<bool>> said{false, true, false, std::nullopt, true, false};
  const auto expect_said = [&said](const Scene& scene) {
    for (std::size_t i = 0; i < said.size(); ++i)
      EXPECT_EQ(scene.mesh->materials.at(i).double_sided, said[i]) << "material " << i;
  };
  const Scene scene = load_good(json);
  expect_said(scene);
  EXPECT_EQ(scene.mesh->materials.back().double_sided, false);  // the default material
  save_scene(scene, own_file("saved.gltf"));
  const Expected<Scene> again = load_scene(own_file("saved.gltf"));
  ASSERT_TRUE(again) << again.error().message();
  expect_said(*again);
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
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1.5}, {"zfar", 9}, {"znear", 1}}}},
      {{"type", "cylindrical"}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"zfar", 9}, {"znear", 1}}}}};
  json["nodes"] = {{{"mesh", 0}},
                   {{"camera", 0}, {"name", "eye"}, {"translation", {0, 0, 4}}},
                   {{"camera", 1}},
                   {{"camera", 2}},
                   {{"camera", 3}}};
  json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->cameras.size(), 2u);
  EXPECT_EQ(scene->cameras[0].name, "eye");
  EXPECT_EQ(scene->cameras[0].eye, glm::vec3(0, 0, 4));
  EXPECT_EQ(scene->cameras[0].target, glm::vec3(0, 0, 3));
  EXPECT_NEAR(scene->cameras[0].fov_deg, 57.29578f, 1e-4f);
  EXPECT_EQ(scene->cameras[1].projection, Projection::orthographic);
  EXPECT_EQ(scene->cameras[1].height, 3.0f);
  EXPECT_EQ(warnings.size(), 2u);  // no such camera, and one without a height
  // Far out, where float's steps are half a unit.
  json["nodes"][1]["translation"] = {5e6, 0, 0};
  json["nodes"][1]["rotation"] = {0, 0.1478094f, 0, 0.9890159f};  // 17 degrees to the left
  const Camera far = load(json)->cameras[0];
  EXPECT_NEAR(glm::normalize(far.target - far.eye).x, -std::sin(glm::radians(17.0f)), 1e-4f);
  save_scene(*scene, own_file("cameras.gltf"));
  const Scene saved = load_scene(own_file("cameras.gltf")).value();
  ASSERT_EQ(saved.cameras.size(), 2u);
  EXPECT_EQ(saved.cameras[1].projection, Projection::orthographic);
  EXPECT_EQ(saved.cameras[1].height, 3.0f);
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
  EXPECT_EQ(scene.mesh->materials[0].diffuse, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.mesh->materials[0].specular, glm::vec3(0.5f));
  EXPECT_EQ(scene.mesh->materials[0].shininess, 30.0f);
  EXPECT_EQ(scene.mesh->materials[0].reflectance, glm::vec3(0.25f));
  EXPECT_EQ(scene.mesh->materials[0].transmittance, glm::vec3(0.75f));
  EXPECT_EQ(scene.mesh->materials[0].ior, 1.33f);
  EXPECT_EQ(scene.mesh->materials[1].emission, glm::vec3(4, 2, 0));
  EXPECT_EQ(scene.mesh->materials[2].ior, 1.4f);
  EXPECT_TRUE(scene.mesh->materials[2].transmits());
  EXPECT_EQ(scene.mesh->materials[3].ior, 1.0f);  // infinitely thin: straight through
  EXPECT_EQ(scene.mesh->materials[4].emission, glm::vec3(0.2f, 0.4f, 0.6f));
  EXPECT_EQ(scene.mesh->materials[4].diffuse, glm::vec3(0.0f));
}

// Ray tracers take the way through a volume from its triangles, says KHR_materials_volume.
TEST(LoadGltf, VolumesTakeLight) {
  Json volume{{"thicknessFactor", 0.1},
              {"thicknessTexture", {{"index", 0}}},
              {"attenuationDistance", 0.5},
              {"attenuationColor", {0.25, 0.5, 1}}};
  const auto read = [&](float transmission = 1.0f) {
    Json json = triangle_json();
    json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                          {"extensions",
                           {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}},
                            {"KHR_materials_volume", volume}}}}};
    json["meshes"][0]["primitives"][0]["material"] = 0;
    Warnings warnings;
    const Scene scene = load(json, &warnings).value();
    EXPECT_TRUE(warnings.empty());
    return scene.mesh->materials[0];
  };
  EXPECT_EQ(read().attenuation_color, glm::vec3(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(read().attenuation_distance, 0.5f);
  EXPECT_FALSE(read(0.0f).attenuates());  // none gets in
  volume["thicknessFactor"] = 0;          // a thin wall
  EXPECT_FALSE(read().attenuates());
  volume["thicknessFactor"] = 1;
  volume.erase("attenuationDistance");  // infinitely far
  EXPECT_FALSE(read().attenuates());
}

TEST(LoadGltf, NormalsOfNoLengthAreMissedBesideOthers) {
  Json json = triangle_json();
  json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});  // zeros
  Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = 2;
  Warnings warnings;
  EXPECT_EQ(load(json, &warnings).value().mesh->normals[0], glm::vec3(0.0f));  // asks for the triangle's own
  EXPECT_TRUE(warnings.empty());
  attributes["NORMAL"] = attributes["POSITION"];  // whose first is the origin
  EXPECT_EQ(load(json, &warnings).value().mesh->normals[0], glm::vec3(0.0f));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].where, "mesh 0");
  EXPECT_NE(warnings[0].what.find("normals of length 0"), std::string::npos);
}

TEST(LoadGltf, ClearCoatAndSheenLieAboveTheBase) {
  Json json = textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}});
  Json& material = json["materials"][0];
  material["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 0.5},
                                                       {"clearcoatRoughnessFactor", 0.25}};
  material["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {0.1, 0.2, 0.3}},
                                                   {"sheenRoughnessFactor", 0.5}};
  const Material m = load_good(json).mesh->materials[0];
  EXPECT_FLOAT_EQ(m.layers.coat, 0.5f);
  EXPECT_FLOAT_EQ(m.layers.coat_roughness, 0.25f);
  EXPECT_FLOAT_EQ(m.layers.sheen.z, 0.3f);
  EXPECT_FLOAT_EQ(m.layers.sheen_roughness, 0.5f);
  material["normalTexture"] = {{"index", 0}};
  material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"] = {{"index", 0}};
  for (const char* follows : {"", "clearcoatNormalTexture"}) {
    if (*follows) material["extensions"]["KHR_materials_clearcoat"][follows] = {{"index", 0}};
    const Scene scene = load_good(json);
    const MaterialMaps& maps = scene.mesh->maps.at(static_cast<std::size_t>(scene.mesh->materials[0].maps));
    EXPECT_TRUE(maps.clearcoat.used());
    EXPECT_EQ(maps.coat_is_mapped, *follows != '\0');
  }
}

// KHR_materials_pbrSpecularGlossiness, which wins over metallic-roughness.
TEST(LoadGltf, SpecularAndGlossinessAreAMattPartWithAMirroringLayer) {
  Json json = textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}});
  json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.5, 0.25, 0.125, 1.0}},
      {"specularFactor", {0.2, 0.3, 0.4}},
      {"glossinessFactor", 0.75}};
  const Material plain = load_good(json).mesh->materials[0];
  EXPECT_NEAR(plain.specular.y, 0.3f, 1e-6f);
  EXPECT_NEAR(plain.diffuse.x, 0.5f / 3.14159265f, 1e-6f);
  EXPECT_NEAR(plain.ggx_alpha, 0.0625f, 1e-6f);
  EXPECT_NEAR(plain.layer.x, 0.4f, 1e-6f);
  json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"]["specularGlossinessTexture"] = {
      {"index", 0}};
  const Scene scene = load_good(json);
  const MaterialMaps& maps = scene.mesh->maps.at(static_cast<std::size_t>(scene.mesh->materials[0].maps));
  ASSERT_TRUE(maps.metallic_roughness.used());
  EXPECT_EQ(maps.surface.roughness, 1.0f);
  // The image is opaque: glossiness is its factor everywhere.
  EXPECT_EQ(
      scene.mesh->textures[static_cast<std::size_t>(maps.metallic_roughness.texture)].image().at(0, 0).g, 64);
}

TEST(LoadGltf, SparseAccessorsAreFilledIn) {
  Json json = triangle_json();
  json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"byteOffset", 2}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}, {"byteOffset", 36}}}};
  EXPECT_EQ(load_good(json).mesh->positions[1], glm::vec3(1, 1, 0));  // the fourth's place in the second
}

TEST(LoadGltf, AnAccessorWithoutDataIsZeros) {
  Json json = triangle_json();
  json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
  json["materials"] = {{{"name", "painted"}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  EXPECT_EQ(load_good(json).mesh->colors.at(0), glm::vec4(0.0f));
}

// KHR_mesh_quantization: whole numbers as positions, bytes as normals and texture coordinates.
TEST(LoadGltf, QuantizedAttributes) {
  const std::int16_t positions[12] = {0, 0, 0, 0, 1000, 0, 0, 0, 0, 1000, 0, 0};  // of 8 bytes each
  const std::int8_t normals[12] = {0, 0, 127, 0, 0, 127, 0, 0, 0, 0, -128, 0};
  const std::uint8_t texcoords[12] = {0, 0, 0, 0, 255, 0, 0, 0, 0, 51, 0, 0};
  Json json = textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}});
  std::ofstream out(own_file("quantized.bin"), std::ios::binary);
  out.write(reinterpret_cast<const char*>(positions), 24).write(reinterpret_cast<const char*>(normals), 12);
  out.write(reinterpret_cast<const char*>(texcoords), 12);
  out.close();
  json["buffers"] = {{{"uri", "quantized.bin"}, {"byteLength", 48}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 24}, {"byteStride", 8}},
                         {{"buffer", 0}, {"byteOffset", 24}, {"byteLength", 12}, {"byteStride", 4}},
                         {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 12}, {"byteStride", 4}}};
  json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5120}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}},
      {{"bufferView", 2}, {"componentType", 5121}, {"count", 3}, {"type", "VEC2"}, {"normalized", true}}};
  json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}},
                                        {"material", 0}};
  json["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
  json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Scene scene = load_good(json);
  EXPECT_LT(glm::length(scene.mesh->positions.at(1) - glm::vec3(1, 0, 0)), 1e-6f);
  EXPECT_LT(glm::length(scene.mesh->normals.at(1) - glm::vec3(0, 1, 0)), 1e-6f);
  EXPECT_LT(glm::length(scene.mesh->normals.at(2) - glm::vec3(0, 0, -1)), 1e-6f);  // -128 is -1 as well
  EXPECT_EQ(scene.mesh->texcoords.at(2), glm::vec2(0.0f, 0.2f));
}

// glTF: -128 is -1, as -127 is.
TEST(LoadGltf, NormalizedIntegersAreAtLeastMinusOne) {
  const std::string bytes("\x80\x7f\0\0\x81\0\0\0", 8), shorts("\0\x80\xff\x7f\x01\x80\0\0", 8);
  for (const auto& [type, stored] : {std::pair(5120, bytes + bytes), std::pair(5122, shorts + shorts)}) {
    Json json = textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}});
    json["buffers"].push_back({{"uri", "data:;base64," + base64(stored)}, {"byteLength", 16}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 16}, {"byteStride", 4}});
    json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", type}, {"count", 4}, {"type", "VEC2"}, {"normalized", true}});
    json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
    json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = load_good(json);
    EXPECT_EQ(scene.mesh->texcoords.at(0), glm::vec2(-1.0f, 1.0f)) << type;
    EXPECT_EQ(scene.mesh->texcoords.at(1), glm::vec2(-1.0f, 0.0f)) << type;
  }
}

// glTF: "When normals are not specified, ... the provided tangents (if present) MUST be ignored."
TEST(LoadGltf, TangentsWithoutNormalsAreLeftOut) {
  const std::string tangents(4 * 16, '\x3f');  // floats of 0.747
  Json json = with_coordinates(textured_json({{"uri", "data:;base64,UDYgMSAxIDI1NQoKFB4="}}));
  json["materials"][0]["normalTexture"] = {{"index", 0}};
  json["buffers"].push_back({{"uri", "data:;base64," + base64(tangents)}, {"byteLength", 64}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 64}});
  json["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
  Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TANGENT"] = 3;
  EXPECT_TRUE(load_good(json).mesh->tangents.empty());
  attributes["NORMAL"] = 0;
  EXPECT_EQ(load_good(json).mesh->tangents.size(), 4u);
}

TEST(LoadGltf, ImagesBesideTheFileAreTextures) {
  std::ofstream(own_file("texel.ppm"), std::ios::binary) << "P6 1 1 255\n\x0a\x14\x1e";
  const Scene scene = load_good(textured_json({{"uri", "texel.ppm"}}));
  ASSERT_EQ(scene.mesh->textures.size(), 1u);
  EXPECT_EQ(scene.mesh->maps_of(0)->base_color.texture, 0);
  EXPECT_EQ(scene.mesh->textures[0].image().at(0, 0), glm::u8vec4(10, 20, 30, 255));
  ASSERT_EQ(scene.source_files.size(), 3u);  // and a buffer
  EXPECT_EQ(scene.source_files.front(), scene.source);
  EXPECT_EQ(std::filesystem::path(scene.source_files.back()), own_file("texel.ppm"));
}

}  // namespace
}  // namespace pinocchio
