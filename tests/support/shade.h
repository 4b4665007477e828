// The composite one pixel at a time, from a mask and a reflection that are given: what the lanes are held
// against.
#pragma once

#include <algorithm>

#include "bench/one_ray/passes.h"
#include "bench/one_ray/surface_at.h"
#include "core/parallel/tiles.h"
#include "core/trace/view/view_params.h"

namespace pinocchio {

struct ShadedLight {
  shared::LightParams params;
  int slot;  // in the mask; -1: does not cast
};

inline std::vector<ShadedLight> shaded_lights(const Scene& scene) {
  std::vector<ShadedLight> lights;
  const std::vector<int> slots = mask_slots(scene);
  for (std::size_t i = 0; i < slots.size(); ++i) lights.push_back({light_params(scene.lights[i]), slots[i]});
  return lights;
}

// Light of the lights that reach the surface: those for which reaches(slot).
template <class Reaches>
glm::vec3 sum_of_lights(const std::vector<ShadedLight>& lights, const SurfaceInteraction& s,
                        const Reaches& reaches) {
  glm::vec3 sum(0.0f);
  for (const ShadedLight& light : lights) {
    if (light.slot >= 0 && !reaches(light.slot)) continue;
    const shared::Incident incident = shared::incident_light(light.params, light.params.position, s.p_world);
    const bool lifted = s.lift != glm::vec3(0.0f) && lifts(kUsualTerminator) &&
                        shared::faces_light_lifted(s.n_shading, s.n_vertices, incident.to_light);
    if (!lifted && !shared::faces_light(s.n_shading, s.n_geometric, incident.to_light)) continue;
    sum += shared::reflected_light(shared::viewed_from(s.to_viewer, s.n_shading, s.material.shading),
                                   incident, s.n_shading, s.to_viewer, true, 0.0f);
  }
  return sum;
}

// Calls shade_pixel(pixel, surface, reaches) for every pixel that sees something, on all threads.
template <class ShadePixel>
void for_each_surface(const TraceJob& job, const Image<std::uint32_t>& ids, const MaskImage& mask,
                      ShadePixel shade_pixel) {
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const std::size_t pixel = ids.index(x, y);
      if (ids[pixel] == kNoTriangle) return;
      const Ray ray = pixel_ray(job.view, x, y);
      shade_pixel(pixel,
                  surface_at(job.tracer.mesh(), ids[pixel], ray.origin, ray.direction, {},
                             Footprint::of_camera(job.view, job.options.texture_footprint)),
                  [&](int slot) { return (mask.get(x, y, slot / 32 * 32) >> slot % 32 & 1u) != 0; });
    });
  });
}

// Each light's reflected light times its mask bit, plus reflection (empty: none). RGBA, linear; A is 1 where
// something is hit. mask of 0 bits: no light casts.
inline void shade(const TraceJob& job, const Image<std::uint32_t>& ids, const MaskImage& mask,
                  const Image<glm::vec3>& reflection, Image<glm::vec4>& color) {
  if (color.size() != ids.size()) color = Image<glm::vec4>(ids.size());
  std::fill(color.pixels().begin(), color.pixels().end(), glm::vec4(0.0f));
  const std::vector<ShadedLight> lights = shaded_lights(job.scene);
  for_each_surface(
      job, ids, mask, [&](std::size_t pixel, const SurfaceInteraction& surface, const auto& reaches) {
        glm::vec3 sum = shared::phong_ambient(surface.material.shading, job.scene.ambient_light) +
                        sum_of_lights(lights, surface, reaches);
        if (!reflection.empty()) sum += reflection[pixel];
        color[pixel] = glm::vec4(sum, 1.0f);
      });
}

// The part of it that the mask decides, and the reflection: added to what `light` holds, linear RGB.
inline void add_traced_light(const TraceJob& job, const Image<std::uint32_t>& ids, const MaskImage& mask,
                             const Image<glm::vec3>& reflection, Image<glm::vec3>& light) {
  std::vector<ShadedLight> casting = shaded_lights(job.scene);
  std::erase_if(casting, [](const ShadedLight& l) { return l.slot < 0; });
  for_each_surface(job, ids, mask,
                   [&](std::size_t pixel, const SurfaceInteraction& surface, const auto& reaches) {
                     light[pixel] += sum_of_lights(casting, surface, reaches);
                     if (!reflection.empty()) light[pixel] += reflection[pixel];
                   });
}

}  // namespace pinocchio
