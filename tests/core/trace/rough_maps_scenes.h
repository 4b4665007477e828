// A floor that mirrors in few spots of its textures.
#pragma once

#include "core/scene/gltf/material_from_surface.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {

// Just too rough to mirror where green is kGreen: a ten thousandth of a smooth spot in a footprint makes it
// mirror.
inline constexpr int kGreen = 250;
inline const float kRoughness = 1.0001f * shared::kRoughestMirror * 255.0f / kGreen;

// All metal, with few smooth spots, small and large.
inline Texture spotted(glm::ivec2 size, Random& random, int spots = 40) {
  Texture texture{"spotted", Image<glm::u8vec4>(size, glm::u8vec4(255, kGreen, 255, 255))};
  for (int spot = 0; spot < spots; ++spot) {
    const glm::ivec2 at(random.next() % as_uint32(size.x), random.next() % as_uint32(size.y));
    const auto green = static_cast<std::uint8_t>(random.next() % 8);
    const int side = 1 << spot % 5;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) texture.texels.at((at.x + x) % size.x, (at.y + y) % size.y).g = green;
  }
  return texture;
}

inline Texture bumps(Random& random) {
  Texture texture{"bumps", Image<glm::u8vec4>({64, 64})};
  for (glm::u8vec4& t : texture.texels.pixels())
    t = {64 + random.next() % 128, 64 + random.next() % 128, 255, 255};
  return texture;
}

// A floor with both under a plate. density: periods of the textures a scene unit; offset: of their
// coordinates.
inline Scene spotted_floor(glm::ivec2 size, Wrap wrap, float density, float offset, Random& random,
                           int spots = 40) {
  Scene scene = plate_over_floor();
  MeshEdit mesh(scene);
  GltfSurface surface{.base_color = glm::vec3(0.8f), .metallic = 1.0f, .roughness = 0.0f};
  Material floor = material_from_surface(surface, Shading::from_file);  // mirrors somewhere
  floor.maps = 0;
  mesh->materials = {floor, Material{}};
  mesh->triangle_materials = {0, 0, 1, 1};
  MaterialMaps maps;
  maps.from_gltf = true;
  surface.roughness = kRoughness;
  maps.surface = surface;
  maps.metallic_roughness.texture = 0;
  maps.metallic_roughness.wrap_u = maps.metallic_roughness.wrap_v = wrap;
  maps.normal.texture = 1;
  mesh->maps = {maps};
  mesh->textures = {spotted(size, random, spots), bumps(random)};
  for (const glm::vec3& p : mesh->positions)
    mesh->texcoords.emplace_back(density * p.x + offset, density * p.z - offset);
  scene.lights = {point_light({1, 0.5f, 3}), point_light({-3, 2, 0})};
  scene.cameras = {{"low", {0.0f, 1.5f, 6.0f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
  return scene;
}

}  // namespace pinocchio
