#include "pinocchio/save.h"

#include <algorithm>

#include "core/scene/gltf/format/glb_size.h"
#include "pinocchio/animation.h"
#include "pinocchio/environment.h"
#include "pinocchio/error.h"
#include "scenes/generator/scenes.h"
#include "tests/support/gltf.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

std::filesystem::path temporary(const std::string& name) {
  return own_file(name);
}

void expect_same_material(const Material& a, const Material& b) {
  EXPECT_EQ(a.ambient, b.ambient);
  EXPECT_EQ(a.diffuse, b.diffuse);
  EXPECT_EQ(a.specular, b.specular);
  EXPECT_EQ(a.shininess, b.shininess);
  EXPECT_EQ(a.reflectance, b.reflectance);
  EXPECT_EQ(a.transmittance, b.transmittance);
  EXPECT_EQ(a.ior, b.ior);
  EXPECT_EQ(a.fresnel, b.fresnel);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.emission[c], b.emission[c], 1e-6f * (1.0f + a.emission[c]));
}

void expect_same_triangles(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(a.positions[a.triangles[i][c]], b.positions[b.triangles[i][c]]) << "triangle " << i;
}

TEST(Save, GltfBringsEverythingBack) {
  for (const char* name : {"two-lights", "cornell", "speedboat"})
    for (const char* extension : {".gltf", ".glb"}) {
      const Scene saved = *make_procedural(name);
      const std::filesystem::path file = temporary(std::string("saved") + extension);
      save_scene(saved, file);
      const Scene loaded = load_or_die(file);
      expect_same_triangles(*saved.mesh, *loaded.mesh);
      EXPECT_EQ(saved.mesh->triangle_materials, loaded.mesh->triangle_materials);
      for (std::size_t i = 0; i < saved.mesh->materials.size(); ++i)
        expect_same_material(saved.mesh->materials[i], loaded.mesh->materials[i]);
      EXPECT_EQ(saved.ambient_light, loaded.ambient_light);
      ASSERT_EQ(saved.lights.size(), loaded.lights.size());
      for (std::size_t i = 0; i < saved.lights.size(); ++i) {
        EXPECT_EQ(saved.lights[i].position, loaded.lights[i].position);
        EXPECT_EQ(saved.lights[i].casts_shadow, loaded.lights[i].casts_shadow);
        EXPECT_EQ(saved.lights[i].falloff, loaded.lights[i].falloff);
        EXPECT_EQ(saved.lights[i].intensity, loaded.lights[i].intensity);
      }
      ASSERT_EQ(saved.cameras.size(), loaded.cameras.size());
      for (std::size_t i = 0; i < saved.cameras.size(); ++i) {
        EXPECT_EQ(saved.cameras[i].eye, loaded.cameras[i].eye);
        EXPECT_EQ(saved.cameras[i].target, loaded.cameras[i].target);
        EXPECT_NEAR(saved.cameras[i].fov_deg, loaded.cameras[i].fov_deg, 1e-4f);
      }
    }
}

TEST(Save, SizesOfLightsLensesAndLobesComeBack) {
  Scene scene = plate_over_floor();
  {
    MeshEdit mesh(scene);
    mesh->materials.front().reflectance = glm::vec3(0.5f);
    mesh->materials.front().gloss = 40.0f;
  }
  Light ball = point_light({1, 2, 3}), sun, panel = point_light({3, 2, 1});
  ball.radius = 0.25f;
  sun.kind = Light::Kind::directional;
  sun.angle_deg = 0.53f;
  panel.kind = Light::Kind::rectangle;
  panel.direction = {0, -1, 0};
  panel.edge_u = {2, 0, 0};
  panel.edge_v = {0, 0, -0.5f};
  scene.lights = {ball, sun, panel};
  scene.cameras.front().lens_radius = 0.125f;
  scene.cameras.front().focus_distance = 3.0f;
  save_scene(scene, temporary("sizes.gltf"));
  const Scene loaded = load_or_die(temporary("sizes.gltf"));
  ASSERT_EQ(loaded.lights.size(), 3u);
  EXPECT_EQ(loaded.lights[0].radius, 0.25f);
  EXPECT_EQ(loaded.lights[1].angle_deg, 0.53f);
  EXPECT_EQ(loaded.lights[2].kind, Light::Kind::rectangle);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(loaded.lights[i].edge_u, scene.lights[i].edge_u), 1e-5f);
    EXPECT_LT(glm::distance(loaded.lights[i].edge_v, scene.lights[i].edge_v), 1e-5f);
    if (i > 0) {
      EXPECT_LT(glm::distance(loaded.lights[i].direction, scene.lights[i].direction), 1e-5f);
    }
  }
  EXPECT_EQ(loaded.cameras.front().lens_radius, 0.125f);
  EXPECT_EQ(loaded.cameras.front().focus_distance, 3.0f);
  EXPECT_EQ(loaded.mesh->materials.front().gloss, 40.0f);
}

TEST(Save, DirectionalAndSpotLightsKeepTheirDirection) {
  Scene scene = plate_over_floor();
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.5f, -1.0f, -0.35f));
  Light spot = point_light({1, 2, 3});
  spot.kind = Light::Kind::spot;
  spot.direction = {0, -1, 0};
  spot.cos_inner = 0.9f;
  spot.cos_outer = 0.7f;
  scene.lights = {sun, spot};
  save_scene(scene, temporary("lights.gltf"));
  const Scene loaded = load_or_die(temporary("lights.gltf"));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(glm::length(loaded.lights[i].direction - scene.lights[i].direction), 1e-6f);
  EXPECT_NEAR(loaded.lights[1].cos_outer, 0.7f, 1e-5f);
}

// Expects that two uses read the same texels, seen the same way.
void expect_same_use(const Mesh& a, const TextureUse& of_a, const Mesh& b, TextureUse of_b) {
  ASSERT_EQ(of_a.used(), of_b.used());
  if (!of_a.used()) return;
  const Texture &ta = a.textures[static_cast<std::size_t>(of_a.texture)],
                &tb = b.textures[static_cast<std::size_t>(of_b.texture)];
  EXPECT_EQ(ta.size(), tb.size());
  EXPECT_TRUE(ta.blocks == tb.blocks);
  of_b.texture = of_a.texture;
  EXPECT_EQ(of_a, of_b);
}

void expect_same_maps(const Mesh& a, const MaterialMaps& of_a, const Mesh& b, MaterialMaps of_b) {
  for (std::size_t i = 0; i < of_a.uses().size(); ++i) {
    expect_same_use(a, *of_a.uses()[i], b, *of_b.uses()[i]);
    *of_b.uses()[i] = *of_a.uses()[i];
  }
  EXPECT_EQ(of_a, of_b);
}

TEST(Save, GltfBringsTexturesBack) {
  Scene saved = load_or_die(source_path("scenes/terrace.glb"));
  {
    MeshEdit edit(saved);
    auto& maps = *std::ranges::find_if(edit->maps, [](const MaterialMaps& m) { return m.base_color.used(); });
    maps.specular = maps.specular_color = maps.transmission = maps.base_color;
  }
  const Mesh& a = *saved.mesh;
  ASSERT_FALSE(a.textures.empty());
  for (const char* extension : {".gltf", ".glb"}) {
    const std::filesystem::path file = temporary(std::string("textured") + extension);
    Warnings warnings;
    save_scene(saved, file, nullptr, &warnings);
    EXPECT_TRUE(warnings.empty());
    const Scene loaded = load_or_die(file);
    const Mesh& b = *loaded.mesh;
    expect_same_triangles(a, b);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::uint32_t i = 0; i < a.triangles.size(); ++i) {
      ASSERT_EQ(a.maps_of(i) == nullptr, b.maps_of(i) == nullptr) << i;
      const glm::uvec3 &ta = a.triangles[i], &tb = b.triangles[i];
      for (int c = 0; c < 3; ++c) {
        ASSERT_LT(glm::length(a.normals[ta[c]] - b.normals[tb[c]]), 1e-6f);
        const MaterialMaps* maps = a.maps_of(i);
        EXPECT_TRUE(!maps || a.texcoords.empty() || a.texcoords[ta[c]] == b.texcoords[tb[c]]);
        EXPECT_TRUE(!maps || !maps->vertex_colors || a.colors[ta[c]] == b.colors[tb[c]]);
      }
    }
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
      expect_same_material(a.materials[i], b.materials[i]);
      if (a.materials[i].maps >= 0)
        expect_same_maps(a, a.maps[static_cast<std::size_t>(a.materials[i].maps)], b,
                         b.maps[static_cast<std::size_t>(b.materials[i].maps)]);
    }
  }
}

// Other viewers do not read our extras.
TEST(Save, GltfOfPlainMaterialsSaysToOthersWhatTheyWere) {
  Json json = triangle_json();
  const Json was{
      {"baseColorFactor", {0.8, 0.4, 0.1, 1.0}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.6}};
  json["materials"] = {{{"pbrMetallicRoughness", was}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  save_scene(load_good(json), temporary("plain.gltf"));
  std::ifstream in(temporary("plain.gltf"));
  const Json saved = Json::parse(in)["materials"][0]["pbrMetallicRoughness"];
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_NEAR(saved["baseColorFactor"][c], was["baseColorFactor"][c], 1e-6);
  EXPECT_NEAR(saved["metallicFactor"], 0.25, 1e-5);
  EXPECT_NEAR(saved["roughnessFactor"], 0.6, 1e-5);
}

TEST(Save, TheColourOfGlassComesBack) {
  MeshData mesh;
  add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Material& glass = mesh.materials[0];
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = 1.5f;
  glass.attenuation_color = {0.5f, 0.25f, 1.0f};
  glass.attenuation_distance = 0.75f;
  const Scene saved(std::move(mesh));
  save_scene(saved, temporary("glass.gltf"));
  EXPECT_EQ(load_or_die(temporary("glass.gltf")).mesh->materials[0].attenuation_color,
            glm::vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(load_or_die(temporary("glass.gltf")).mesh->materials[0].attenuation_distance, 0.75f);
  Warnings warnings;
  save_scene(saved, temporary("glass.obj"), nullptr, &warnings);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(Save, GltfKeepsTheMotion) {
  const Scene saved = load_or_die(source_path("scenes/windmill.glb"));
  ASSERT_GT(duration_s(saved), 0.0);
  save_scene(saved, temporary("moving.gltf"));
  const Scene loaded = load_or_die(temporary("moving.gltf"));
  for (const double seconds : {0.0, 0.4, 1.9}) {
    const Scene a = at_time(saved, seconds).value(), b = at_time(loaded, seconds).value();
    expect_same_triangles(*a.mesh, *b.mesh);
    EXPECT_EQ(a.mesh->triangle_materials, b.mesh->triangle_materials);
    EXPECT_EQ(a.lights.size(), b.lights.size());
  }
  Warnings warnings;
  save_scene(saved, temporary("still.obj"), nullptr, &warnings);
  EXPECT_FALSE(warnings.empty());
}

// A quad with an image of its own for colour and one for alpha, as MTL has it.
Scene dissolved() {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.resize(4, glm::vec3(0.0f));
  mesh.texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_materials = {0, 0};
  for (const char* name : {"colour", "alpha"}) {
    Texture& texture = mesh.textures.edit().emplace_back();
    texture.name = name;
    texture.texels = Image<glm::u8vec4>({2, 2}, glm::u8vec4(200, 100, 50, 255));
  }
  mesh.textures.edit()[1].texels.at(1, 0) = glm::u8vec4(0, 0, 0, 255);
  MaterialMaps& maps = make_maps(mesh, mesh.materials.emplace_back());
  maps.base_color.texture = 0;
  maps.alpha = maps.base_color;
  maps.alpha.texture = 1;
  maps.alpha_channel = 0;
  maps.alpha_mode = AlphaMode::blend;
  maps.base_color.uv_from_texcoord = maps.alpha.uv_from_texcoord = {2.0f, 0.0f, 0.0f, 3.0f, 0.25f, -0.5f};
  return Scene(std::move(mesh));
}

TEST(Save, WhatIsAroundTheSceneIsMissed) {
  Scene scene = load_or_die(source_path("scenes/cornell.gltf"));
  Image<glm::vec3> sky({4, 2}, glm::vec3(1.0f));
  scene.environment = std::make_shared<const Environment>(std::move(sky), "sky.hdr");
  for (const char* name : {"sky.gltf", "sky.obj"}) {
    Warnings warnings;
    save_scene(scene, temporary(name), nullptr, &warnings);
    EXPECT_FALSE(warnings.empty()) << name;
  }
}

TEST(Save, GltfTakesAlphaFromWhereMtlHasIt) {
  save_scene(dissolved(), temporary("dissolved.glb"));
  const Scene loaded = load_or_die(temporary("dissolved.glb"));
  const MaterialMaps& maps = loaded.mesh->maps.at(0);
  const Texture& both = loaded.mesh->textures[static_cast<std::size_t>(maps.base_color.texture)];
  EXPECT_EQ(both.image().at(0, 0), glm::u8vec4(200, 100, 50, 200));
  EXPECT_EQ(both.image().at(1, 0), glm::u8vec4(200, 100, 50, 0));
  EXPECT_TRUE(maps.blends());
  EXPECT_EQ(maps.base_color.uv_from_texcoord, glm::mat3x2(2.0f, 0.0f, 0.0f, 3.0f, 0.25f, -0.5f));
}

TEST(Save, ObjBringsTexturesBackAndSaysWhatItCannot) {
  Scene scene = dissolved();
  Warnings warnings;
  save_scene(scene, temporary("dissolved.obj"), nullptr, &warnings);
  EXPECT_TRUE(warnings.empty());
  const Scene loaded = load_or_die(temporary("dissolved.obj"));
  expect_same_triangles(*scene.mesh, *loaded.mesh);
  EXPECT_EQ(loaded.mesh->normals.at(0), glm::vec3(0.0f));  // flat, as it was
  const MaterialMaps& maps = loaded.mesh->maps.at(0);
  expect_same_use(*scene.mesh, scene.mesh->maps[0].base_color, *loaded.mesh, maps.base_color);
  expect_same_use(*scene.mesh, scene.mesh->maps[0].alpha, *loaded.mesh, maps.alpha);
  EXPECT_EQ(maps.alpha_channel, 0);
  scene.mesh = load_or_die(source_path("scenes/terrace.glb")).mesh;
  save_scene(scene, temporary("terrace.obj"), nullptr, &warnings);
  EXPECT_FALSE(warnings.empty());
}

TEST(Save, ObjBringsTrianglesAndMaterialsBack) {
  const Scene saved = *make_procedural("cornell");
  save_scene(saved, temporary("saved.obj"));
  const Scene loaded = load_or_die(temporary("saved.obj"));
  expect_same_triangles(*saved.mesh, *loaded.mesh);
  for (std::uint32_t i = 0; i < saved.mesh->triangles.size(); i += 97) {
    EXPECT_EQ(saved.mesh->material_of(i).diffuse, loaded.mesh->material_of(i).diffuse);
    EXPECT_EQ(saved.mesh->material_of(i).reflectance, loaded.mesh->material_of(i).reflectance);
    EXPECT_EQ(saved.mesh->material_of(i).transmittance, loaded.mesh->material_of(i).transmittance);
  }
}

TEST(Save, ObjKeepsEveryBitOfOddNumbers) {
  Random random(11);
  MeshData mesh;
  for (int i = 0; i < 500; ++i) {
    const auto odd = [&random] {
      return std::ldexp(random.between(-1.0f, 1.0f), static_cast<int>(random.next() % 40) - 20);
    };
    const auto point = [&odd] {
      const float x = odd(), y = odd();
      return glm::vec3(x, y, odd());
    };
    const glm::vec3 a = point(), b = point();
    add_triangle(mesh, a, b, point());
  }
  const Scene saved(std::move(mesh));
  save_scene(saved, temporary("odd numbers.obj"));  // nor does a space in the name lose the materials
  Warnings warnings;
  const Expected<Scene> loaded = load_scene(temporary("odd numbers.obj"), &warnings);
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(warnings.empty());
  expect_same_triangles(*saved.mesh, *loaded->mesh);
}

// Its header has 32 bits for each length.
TEST(Save, TheSizeOfAGlbIsWhatItsHeaderHolds) {
  constexpr std::uint64_t kGib4 = std::uint64_t{1} << 32;
  EXPECT_EQ(glb_bytes(5, 6), 28u + 8 + 8);
  EXPECT_EQ(glb_bytes(4, kGib4 - 36), kGib4 - 4);
  EXPECT_FALSE(glb_bytes(5, kGib4 - 36));
  EXPECT_FALSE(glb_bytes(4, kGib4 - 35));
  EXPECT_FALSE(glb_bytes(0, kGib4));
  EXPECT_FALSE(glb_bytes(kGib4, 0));
  EXPECT_FALSE(glb_bytes(0, ~std::uint64_t{0}));
  const std::filesystem::path file = temporary("size.glb");
  save_scene(plate_over_floor(), file);
  std::ifstream in(file, std::ios::binary);
  std::uint32_t header[3];
  in.read(reinterpret_cast<char*>(header), sizeof header);
  EXPECT_EQ(header[2], std::filesystem::file_size(file));
}

TEST(Save, NamesThatAreNotUtf8DoNotStopIt) {
  Scene scene = plate_over_floor();
  MeshEdit(scene)->materials[0].name = "gr\xfcn";
  save_scene(scene, temporary("latin.gltf"));
  EXPECT_EQ(load_or_die(temporary("latin.gltf")).mesh->triangles.size(), scene.mesh->triangles.size());
}

TEST(Save, WhatCannotBeWrittenIsAnError) {
  const Scene scene = plate_over_floor();
  EXPECT_THROW(save_scene(scene, "/nowhere/x.gltf"), EnvironmentError);
  EXPECT_THROW(save_scene(scene, temporary("x.stl")), EnvironmentError);
}

TEST(Save, TheScenesInTheRepositoryAreWhatTheGeneratorMakes) {
  for (const char* name : {"two-lights", "cornell", "speedboat"}) {
    const Scene made = *make_procedural(name),
                stored = load_or_die(source_path(std::string("scenes/") + name));
    ASSERT_EQ(made.mesh->triangles.size(), stored.mesh->triangles.size())
        << "write scenes/" << name << " again: pinocchio generate";
    float largest = 0.0f;  // sines may differ in the last bit between libraries
    for (std::size_t i = 0; i < made.mesh->triangles.size(); ++i)
      largest = std::max(largest, glm::length(made.mesh->positions[made.mesh->triangles[i].x] -
                                              stored.mesh->positions[stored.mesh->triangles[i].x]));
    EXPECT_LT(largest, 1e-3f) << name;
  }
}

}  // namespace
}  // namespace pinocchio
