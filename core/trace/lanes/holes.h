// Part of walk/kernel.h's files: points where alpha lets rays pass as if nothing were there.
#pragma once

#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"
#include "core/trace/rays/passed_surfaces.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

unsigned lanes_in_holes(const PassedSurfaces& passed, const RayColumns& rays, std::size_t first,
                        unsigned asked, std::uint32_t triangle) {
  const SceneArrays& scene = *passed.scene;
  const Mask lanes = Mask::from_bits(asked);
  const glm::uvec3& corners = scene.triangles[triangle];
  const Vec a(scene.positions[corners.x]);
  const Vec weights =
      barycentric_of(Vec::load(rays.origin, first), Vec::load(rays.direction, first), a,
                     Vec(scene.positions[corners.y]) - a, Vec(scene.positions[corners.z]) - a);
  const LaneMaps& maps = scene.maps[scene.materials[scene.triangle_materials[triangle]].maps];
  const Float alpha = alpha_at(scene, maps, Int(triangle), weights, lanes);
  return (lanes & is_hole(as_int(maps.maps->alpha_mode), alpha, maps.maps->alpha_cutoff)).bits();
}

void find_holes(const Bounce& bounce, const RayQueue& rays, std::uint32_t* holes) {
  const SceneArrays& scene = bounce.scene;
  const auto maps_of = [&](std::uint32_t material) -> const LaneMaps* {
    const int index = scene.materials[material].maps;
    return index < 0 ? nullptr : scene.maps + index;
  };
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    Int(0u).store(holes + i);
    if (!scene.maps) continue;
    const Int triangle = Int::load(rays.triangle + i);
    Int material(0u);
    unsigned porous = 0;
    for_each_distinct(triangle, lanes_from(i, rays.size) & ~(triangle == Int(kNoTriangle)),
                      [&](std::uint32_t id, Mask same) {
                        const std::uint32_t of_triangle = scene.triangle_materials[id];
                        const LaneMaps* const maps = maps_of(of_triangle);
                        if (!maps || !maps->maps->has_holes()) return;
                        material = select(same, Int(of_triangle), material);
                        porous |= same.bits();
                      });
    if (porous == 0) continue;
    const Mask lanes = Mask::from_bits(porous);
    const Corners corners(scene, triangle, lanes);
    const Vec& a = corners.position[0];
    const Vec weights = barycentric_of(Vec::load(rays.origin, i), Vec::load(rays.direction, i), a,
                                       corners.position[1] - a, corners.position[2] - a);
    unsigned found = 0;
    for_each_distinct(material, lanes, [&](std::uint32_t index, Mask same) {
      const LaneMaps& maps = *maps_of(index);
      const Float alpha = alpha_at(scene, maps, triangle, weights, same);
      found |= (same & is_hole(as_int(maps.maps->alpha_mode), alpha, maps.maps->alpha_cutoff)).bits();
    });
    select(Mask::from_bits(found), Int(1u), Int(0u)).store(holes + i);
  }
}

void go_behind(const Bounce& bounce, bool ends, RayQueue& rays) {
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Corners corners(bounce.scene, Int::load(rays.triangle + i), lanes_from(i, rays.size));
    const Vec origin = Vec::load(rays.origin, i), direction = Vec::load(rays.direction, i);
    const Vec behind = offset_origin(surface_of(corners, origin, direction, bounce.offset), direction);
    put(behind, rays.origin, i);
    if (ends) put(origin + direction - behind, rays.direction, i);
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
