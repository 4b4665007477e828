// What files say of textures and alpha arrives in materials' maps.
#include "core/scene/gltf/material_from_surface.h"
#include "core/scene/obj/mtl.h"
#include "core/scene/obj/mtl_features.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

TEST(LoadMaterials, GltfTexturesSamplersAndTransforms) {
  std::ofstream(own_file("texel.ppm"), std::ios::binary) << "P6 1 1 255\n\x0a\x14\x1e";
  Json json = textured_json({{"uri", "texel.ppm"}});
  json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  json["textures"][0]["sampler"] = 0;
  Json& material = json["materials"][0];
  material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  material["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {
      {"index", 0},
      {"texCoord", 0},  // the extension's own goes before it
      {"extensions",
       {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.75;
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0;
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 2;
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(warnings.empty());
  const MaterialMaps* maps = scene->mesh->maps_of(0);
  ASSERT_NE(maps, nullptr);
  EXPECT_EQ(maps->base_color.wrap_u, Wrap::clamp);
  EXPECT_EQ(maps->base_color.wrap_v, Wrap::mirror);
  EXPECT_TRUE(maps->base_color.nearest);
  EXPECT_EQ(maps->emissive.uv_set, 1);
  EXPECT_EQ(maps->normal_scale, 0.5f);
  EXPECT_EQ(maps->occlusion_strength, 0.25f);
  EXPECT_EQ(maps->metallic_roughness.uv_from_texcoord, glm::mat3x2(2, 0, 0, 3, 0.5f, 0.25f));
  EXPECT_EQ(maps->metallic_roughness.uv_set, 1);
  EXPECT_EQ(maps->alpha_mode, AlphaMode::mask);
  EXPECT_EQ(maps->alpha_cutoff, 0.75f);
  EXPECT_EQ(maps->alpha, maps->base_color);
  EXPECT_EQ(scene->mesh->texcoords1.size(), scene->mesh->positions.size());
}

TEST(LoadMaterials, GltfTexturesLieAtZeroWithoutCoordinates) {
  std::ofstream(own_file("texel.ppm"), std::ios::binary) << "P6 1 1 255\n\x0a\x14\x1e";
  const Scene scene = load_good(textured_json({{"uri", "texel.ppm"}}));
  EXPECT_EQ(scene.mesh->texcoords, std::vector<glm::vec2>(scene.mesh->positions.size(), glm::vec2(0.0f)));
  EXPECT_TRUE(scene.mesh->texcoords1.empty());
}

TEST(LoadMaterials, GltfTexturesOfSpecularAndTransmission) {
  // Opaque here, clear there: what mirrors and what lets light through are both kept rays for.
  std::ofstream(own_file("texels.ppm"), std::ios::binary) << "P6 2 1 255\n"
                                                          << std::string("\0\0\0\xff\xff\xff", 6);
  Json json = textured_json({{"uri", "texels.ppm"}});
  Json& material = json["materials"][0];
  material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0}};
  material["extensions"]["KHR_materials_specular"] = {
      {"specularTexture", {{"index", 0}}}, {"specularColorTexture", {{"index", 0}, {"texCoord", 1}}}};
  material["extensions"]["KHR_materials_transmission"] = {
      {"transmissionFactor", 1},
      {"transmissionTexture",
       {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}}}}}}}};
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] = 2;
  Warnings warnings;
  const Expected<Scene> scene = load(json, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(warnings.empty());
  const MaterialMaps* maps = scene->mesh->maps_of(0);
  ASSERT_NE(maps, nullptr);
  EXPECT_EQ(maps->specular.texture, 0);
  EXPECT_EQ(maps->specular_color.uv_set, 1);
  EXPECT_EQ(maps->transmission.uv_from_texcoord, glm::mat3x2(2, 0, 0, 3, 0, 0));
  EXPECT_TRUE(scene->mesh->material_of(0).reflects());
  EXPECT_TRUE(scene->mesh->material_of(0).transmits());
}

TEST(LoadMaterials, GltfVertexColorsOfThreeOrFourNumbers) {
  Json json = triangle_json();
  json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5121}, {"normalized", true}, {"count", 4}, {"type", "VEC4"}});
  json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  const Scene scene = load_good(json);
  ASSERT_EQ(scene.mesh->colors.size(), 4u);
  ASSERT_NE(scene.mesh->maps_of(0), nullptr);
  EXPECT_TRUE(scene.mesh->maps_of(0)->vertex_colors);
}

TEST(LoadMaterials, WhatBlendsAndIsWholeIsOpaque) {
  Json json = triangle_json();
  json["materials"] = {{{"alphaMode", "BLEND"}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_EQ(load_good(json).mesh->maps_of(0), nullptr);
  json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  EXPECT_TRUE(load_good(json).mesh->maps_of(0)->blends());
}

std::vector<MtlMaterial> read_materials(std::string_view text) {
  return read_mtl(text).materials;
}

// A texture makes it mirror here and transmit there, which its surface alone does not.
TEST(LoadMaterials, AnEditedSurfaceKeepsTheRaysOfItsTextures) {
  std::ofstream(own_file("texels.ppm"), std::ios::binary) << "P6 2 1 255\n"
                                                          << std::string("\0\0\0\xff\xff\xff", 6);
  Json json = textured_json({{"uri", "texels.ppm"}});
  Json& material = json["materials"][0];
  material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0}};
  material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1.0},
                                                          {"transmissionTexture", {{"index", 0}}}};
  const Scene scene = load_good(json);
  const Mesh& mesh = *scene.mesh;
  const Material& loaded = mesh.material_of(0);
  ASSERT_TRUE(loaded.reflects() && loaded.transmits());
  const GltfSurface surface = mesh.maps_of(0)->surface;
  EXPECT_EQ(with_surface(mesh, loaded, surface), loaded);
  EXPECT_FALSE(material_from_surface(surface, Shading::from_file).reflects());
}

// The mode stays as the file has it; it only has no effect.
TEST(LoadMaterials, AlphaThatLetsNothingPassIsNotAskedFor) {
  const auto mesh_with = [](AlphaMode mode, std::uint8_t least, float factor, float vertex = 1.0f) {
    MeshData mesh;
    mesh.materials = {Material{}};
    add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Texture texture{"alpha", Image<glm::u8vec4>({3, 2}, glm::u8vec4(10, 20, 30, 255))};
    texture.texels.at(2, 1).a = least;
    mesh.textures = {texture};
    if (vertex != 1.0f) mesh.colors = {glm::vec4(1.0f), glm::vec4(1.0f), {1.0f, 1.0f, 1.0f, vertex}};
    MaterialMaps& maps = make_maps(mesh, mesh.materials[0]);
    maps.alpha_mode = mode;
    maps.alpha.texture = 0;
    maps.alpha_factor = factor;
    return Mesh(std::move(mesh));
  };
  struct Case {
    AlphaMode mode;
    std::uint8_t least;
    float factor, vertex;
    bool is_opaque;
  };
  for (const Case& c : {Case{AlphaMode::blend, 255, 1.0f, 1.0f, true},
                        {AlphaMode::blend, 254, 1.0f, 1.0f, false},
                        {AlphaMode::blend, 255, 0.99f, 1.0f, false},
                        {AlphaMode::blend, 255, 1.0f, 0.9f, false},
                        {AlphaMode::mask, 255, 0.5f, 1.0f, true},
                        {AlphaMode::mask, 128, 1.0f, 1.0f, true},
                        {AlphaMode::mask, 127, 1.0f, 1.0f, false},
                        {AlphaMode::mask, 255, 1.0f, 0.1f, false}}) {
    const Mesh mesh = mesh_with(c.mode, c.least, c.factor, c.vertex);
    const MaterialMaps& maps = mesh.maps[0];
    EXPECT_EQ(maps.alpha_mode, c.mode);
    EXPECT_EQ(maps.has_holes() || maps.blends(), !c.is_opaque)
        << static_cast<int>(c.mode) << ", " << int{c.least} << ", " << c.factor << ", " << c.vertex;
  }
}

TEST(LoadMaterials, MtlStatements) {
  const std::vector<MtlMaterial> all = read_materials(
      "newmtl red car paint \r\nKd 0.5\nTr 0.25\nmap_Kd -s 2 3 -o 0.5 -clamp on my picture.png\n"
      "map_Bump -bm 0.5 sub\\bump.png\nmap_d -imfchan g holes.png\nPm 0.75\n"
      "newmtl two\nd -halo 0.5\nTr 0.9\nmap_Kd 1.png\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "red car paint");
  EXPECT_EQ(all[0].kd, glm::vec3(0.5f));
  EXPECT_EQ(all[0].dissolve, 0.75f);
  EXPECT_EQ(all[0].map_kd.file, "my picture.png");
  EXPECT_EQ(all[0].map_kd.scale, glm::vec2(2, 3));
  EXPECT_EQ(all[0].map_kd.offset, glm::vec2(0.5f, 0));
  EXPECT_TRUE(all[0].map_kd.clamp);
  EXPECT_EQ(all[0].map_bump.bump, 0.5f);
  EXPECT_EQ(all[0].map_bump.file, "sub/bump.png");
  EXPECT_EQ(all[0].map_d.channel, 'g');
  EXPECT_EQ(all[0].metallic, 0.75f);
  EXPECT_EQ(all[1].dissolve, 0.5f);  // d counts, not its opposite
  EXPECT_EQ(all[1].map_kd.file, "1.png");
}

TEST(LoadMaterials, MtlColoursAreNotNegative) {
  const std::string text = "newmtl odd\nKd -1 0.5 -0.25\nKs 0 -0 0\nTf 1 -1 1\n";
  const MtlMaterial material = read_materials(text).at(0);
  EXPECT_EQ(material.kd, glm::vec3(0, 0.5f, 0));
  EXPECT_EQ(material.tf, glm::vec3(1, 0, 1));
  Warnings warnings;
  add_lost_mtl_features("odd.mtl", text, warnings);
  ASSERT_EQ(warnings.size(), 2u);
  for (const auto& [i, words] : {std::pair(0u, "line 2: Kd is negative; negative values are read as 0"),
                                 std::pair(1u, "line 4: Tf is negative; negative values are read as 0")})
    EXPECT_NE(warnings[i].message().find(words), std::string::npos) << warnings[i].message();
}

TEST(LoadMaterials, MtlNamesMayHoldBlanksAndNumbers) {
  const std::vector<MtlMaterial> all = read_materials(
      "newmtl  spectral  2 red \nmap_Kd -clamp on two words 3.png\nmap_Bump -bm 0.5 2 bricks.png\n"
      "map_d -mm 0 1 3 holes.png\nmap_Ke \"in quotes.png\"\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "spectral  2 red");
  EXPECT_EQ(all[0].map_kd.file, "two words 3.png");
  EXPECT_EQ(all[0].map_bump.file, "2 bricks.png");
  EXPECT_EQ(all[0].map_bump.bump, 0.5f);
  EXPECT_EQ(all[0].map_d.file, "3 holes.png");
  EXPECT_EQ(all[0].map_ke.file, "in quotes.png");
}

TEST(LoadMaterials, MtlTrIsOpacityWhereItsWriterMeansThat) {
  const std::string meshlab = "#\n# Wavefront material file\n# Converted by Meshlab Group\n#\n\n";
  const auto dissolves = [](const std::string& text) {
    std::vector<float> values;
    for (const MtlMaterial& m : read_mtl(text).materials) values.push_back(m.dissolve);
    return values;
  };
  const std::string two = "newmtl a\nTr 1.000000\nnewmtl b\nTr 0.250000\n";
  EXPECT_EQ(dissolves(meshlab + two), (std::vector{1.0f, 0.25f}));
  EXPECT_EQ(dissolves(two), (std::vector{0.0f, 0.75f}));
  EXPECT_EQ(dissolves(meshlab + "newmtl a\nTr 0\nnewmtl b\nTr 0.25\n"), (std::vector{1.0f, 0.75f}));
  EXPECT_EQ(dissolves("newmtl a\nTr 1\nnewmtl b\nTr 1\n"), (std::vector{1.0f, 1.0f}));
  EXPECT_EQ(dissolves("newmtl a\nTr 1\nnewmtl b\nKd 1 1 1\n"), (std::vector{0.0f, 1.0f}));
  EXPECT_EQ(dissolves(meshlab + "newmtl a\nTr 0.5\nd 0.125\nnewmtl b\nd 0.125\nTr 0.5\n"),
            (std::vector{0.125f, 0.125f}));
  EXPECT_EQ(dissolves("newmtl glass\nillum 7\nNi 1.5\nTr 1\n"), (std::vector{0.0f}));
  EXPECT_TRUE(read_mtl(two).opacity_reason.empty());

  std::ofstream(own_file("tr.mtl")) << meshlab << "newmtl m\nKd 1 1 1\nTr 1.000000\n";
  std::ofstream(own_file("tr.obj")) << "mtllib tr.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  Warnings warnings;
  const Expected<Scene> scene = load_scene(own_file("tr.obj"), &warnings);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->mesh->maps_of(0), nullptr);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("tr.mtl: Tr is read as opacity: its header names MeshLab"),
            std::string::npos);
}

// -imfchan: l is the luminance.
TEST(LoadMaterials, MtlAlphaIsTheChannelItNames) {
  std::ofstream(own_file("a.ppm"), std::ios::binary) << "P6 1 1 255\n\x64\xc8\x32";  // 100, 200, 50
  std::ofstream(own_file("a.obj"))
      << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  for (const auto& [channel, alpha] : {std::pair("r", 100), std::pair("b", 50), std::pair("l", 168)}) {
    std::ofstream(own_file("a.mtl")) << "newmtl m\nmap_d -imfchan " << channel << " a.ppm\n";
    const Expected<Scene> scene = load_scene(own_file("a.obj"));
    ASSERT_TRUE(scene) << channel;
    const MaterialMaps* maps = scene->mesh->maps_of(0);
    ASSERT_NE(maps, nullptr) << channel;
    EXPECT_TRUE(maps->blends()) << channel;
    const glm::u8vec4 texel = scene->mesh->textures[maps->alpha.texture].image().at(0, 0);
    EXPECT_EQ(texel[maps->alpha_channel], alpha) << channel;
  }
}

TEST(LoadMaterials, MtlDissolveBlendsUnlessItRefracts) {
  const auto maps_of = [](const std::string& mtl) {
    std::ofstream(own_file("d.mtl")) << "newmtl m\nKd 1 1 1\n" << mtl;
    std::ofstream(own_file("d.obj")) << "mtllib d.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    const Expected<Scene> scene = load_scene(own_file("d.obj"));
    EXPECT_TRUE(scene);
    const MaterialMaps* maps = scene->mesh->maps_of(0);
    return maps ? std::optional(*maps) : std::nullopt;
  };
  EXPECT_FALSE(maps_of("d 1\n"));
  const auto half = maps_of("d 0.5\n");
  ASSERT_TRUE(half);
  EXPECT_TRUE(half->blends());
  EXPECT_EQ(half->alpha_factor, 0.5f);
  EXPECT_FALSE(maps_of("d 0.5\nillum 7\nNi 1.5\n"));
}

}  // namespace
}  // namespace pinocchio
