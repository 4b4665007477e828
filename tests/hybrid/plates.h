// A scene and ways to draw it, for what is behind a scene and below it.
#pragma once

#include "tests/support/draw.h"

namespace pinocchio {

inline constexpr glm::ivec2 kPlateSize{160, 120};
inline const glm::vec3 kColor{0.25f, 0.5f, 0.75f};

// Two plates above each other that mirror a little, under a sky of one colour; with a pane that blends before
// them.
inline Scene plates(bool with_pane) {
  MeshData mesh;
  const auto square = [&mesh](float half, glm::vec3 at) {
    add_triangle(mesh, at + glm::vec3(-half, 0, half), at + glm::vec3(half, 0, half),
                 at + glm::vec3(half, 0, -half));
    add_triangle(mesh, at + glm::vec3(-half, 0, half), at + glm::vec3(half, 0, -half),
                 at + glm::vec3(-half, 0, -half));
  };
  square(1.0f, {0, 1, 0});
  square(0.7f, {0.4f, 0.5f, 0.3f});
  mesh.materials[0].reflectance = glm::vec3(0.2f);
  if (with_pane) {
    Material pane;
    pane.diffuse = {0.2f, 0.1f, 0.0f};
    MaterialMaps& maps = make_maps(mesh, pane);
    maps.alpha_mode = AlphaMode::blend;
    maps.alpha_factor = 0.4f;
    mesh.materials.push_back(pane);
    square(0.8f, {-0.9f, 1.5f, 0.8f});
    mesh.triangle_materials[4] = mesh.triangle_materials[5] = 1;
  }
  Scene scene(std::move(mesh));
  scene.cameras = {{"above", {0.0f, 5.0f, 6.0f}, {0.0f, 0.5f, 0.0f}, {0, 1, 0}, 45.0f}};
  scene.lights = {point_light({1, 6, 5})};
  scene.lights[0].intensity = 0.5f;
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({4, 2}, {0.3f, 0.2f, 0.1f}));
  return scene;
}

struct Way {
  std::string name;
  Settings settings;
  double most;  // of what two pictures may differ by in a pixel, for the ways' formats
};
inline std::vector<Way> ways() {
  Settings camera_rays = by({{"mode", "hybrid"}}), reprojected = by({{"mode", "hybrid"}});
  camera_rays.visibility = Processor::cpu;
  reprojected.exchange = Exchange::reproject;
  return {{"raytrace", by({{"mode", "raytrace"}}), 1e-5},
          {"design 1", by({{"design", "1"}}), 2e-3},
          {"camera rays", camera_rays, 2e-3},
          {"design 2", by({{"design", "2"}}), 5e-3},
          {"reprojected", reprojected, 2e-3},
          {"raster", by({{"mode", "raster"}}), 2e-3}};
}

inline FrameResult drawn(const Scene& scene, Settings settings, std::string_view background, int spp = 4) {
  settings.exchange.fill(Exchange::sync);
  settings.spp = spp;
  EXPECT_TRUE(set(settings, "background", background));
  return draw_one(scene, {settings, kPlateSize});
}

// The largest difference to the transparent picture over the colour, in any pixel and component.
inline double most_apart(const FrameResult& whole, const FrameResult& transparent, const glm::vec3& color) {
  double most = 0.0;
  for (std::size_t i = 0; i < whole.color.pixels().size(); ++i) {
    const glm::vec4& own = transparent.color[i];
    const glm::vec3 over = glm::vec3(own) + (1.0f - own.a) * color;
    for (int c = 0; c < 3; ++c)
      most = std::max(most, static_cast<double>(std::abs(whole.color[i][c] - over[c])));
    most = std::max(most, static_cast<double>(std::abs(whole.color[i].a - own.a)));
  }
  return most;
}

inline std::size_t count(const FrameResult& picture, bool (*is)(const glm::vec4&)) {
  return static_cast<std::size_t>(std::ranges::count_if(picture.color.pixels(), is));
}

}  // namespace pinocchio
