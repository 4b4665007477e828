// Part of walk/kernel.h's files: shadow rays that go straight on through glass, and through what blends.
#pragma once

#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/medium.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The share of light that passes a surface straight on: what Fresnel's equations leave of it, filtered. The
// ray is not bent, so its angle counts as the one outside on both sides of a body: inside it would be beyond
// the critical angle where the bent ray is not. Thin walls of glTF's model mirror by Schlick's formula.
inline Vec share_straight_on(const LaneSurface& s, const LaneMaterial& m) {
  const Float one(1.0f), cosine = clamp(dot(s.n_shading, s.to_viewer), 0.0f, 1.0f);
  return m.transmittance * (one - glass_mirror(m, cosine, m.ior).kept);
}

// The share of light that the surfaces do not stop: beside a surface that blends, and through glass.
inline Vec share_passed(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m) {
  const bool tinted = m.transmits != 0 && bounce.options->glass_shadows == GlassShadows::tinted;
  const Vec through = tinted ? share_straight_on(s, m) : Vec(Float(0.0f));
  if (m.blends == 0) return through;
  return Vec(Float(1.0f) - m.alpha) + m.alpha * through;
}

void cross_glass(const Bounce& bounce, const std::uint32_t* holes, bool ends, RayQueue& rays) {
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Mask lanes = lanes_from(i, rays.size);
    const Int triangle = Int::load(rays.triangle + i);
    const Mask met = lanes & ~(triangle == Int(kNoTriangle)), arrived = lanes & ~met;
    const Vec origin = Vec::load(rays.origin, i), direction = Vec::load(rays.direction, i);
    Vec light = Vec::load(rays.light, i);
    const Int medium = rays.medium ? Int::load(rays.medium + i) : Int(kNoMedium);
    if (rays.medium && ends && arrived.bits() != 0)
      light = select(arrived, light * attenuation(bounce, medium, length(direction), arrived), light);
    if (met.bits() != 0) {
      const Corners corners(bounce.scene, triangle, met);
      LaneSurface s = surface_of(corners, origin, direction, bounce.offset);
      LaneMaterial m(bounce.scene, corners.material, met);
      const MapsWanted wanted = m.transmits != 0 ? MapsWanted(true, true, true, false, false) : MapsWanted();
      if (m.mapped != 0) apply_maps(bounce, corners, triangle, origin, direction, Float(0.0f), wanted, s, m);
      if (m.microfacet != 0) turn_normals_to_viewer(s, m);
      const Mask hole = met & ~(Int::load(holes + i) == Int(0u));
      light = select(met & ~hole, light * share_passed(bounce, s, m), light);
      if (rays.medium) {
        const LaneMedia media = media_at(bounce, medium, corners.material, s, m.ior, met);
        const Int here = select(hole, medium, media.here);
        light = select(met, light * attenuation(bounce, here, length(s.p_world - origin), met), light);
        select(hole, medium, media.beyond).store(rays.medium + i);
      }
      const Vec behind = offset_origin(s, direction);
      put(behind, rays.origin, i);
      if (ends) put(origin + direction - behind, rays.direction, i);
    }
    put(light, rays.light, i);
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
