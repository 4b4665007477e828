// Part of walk/kernel.h's files: materials with maps, for the lanes that have one.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/surface.h"
#include "core/trace/lanes/texture.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline void store(const Vec& v, MapLanes::Column (&columns)[3]) {
  v.x.store(columns[0]);
  v.y.store(columns[1]);
  v.z.store(columns[2]);
}

inline Vec load(const MapLanes::Column (&columns)[3]) {
  return {Float::load(columns[0]), Float::load(columns[1]), Float::load(columns[2])};
}

// Not inlined: it is large, and most packets have no maps.
[[gnu::noinline]] void apply_maps(const Bounce& bounce, Int triangle, const Vec& origin, const Vec& direction,
                                  Float width, LaneSurface& s, LaneMaterial& m) {
  MapLanes packet;
  triangle.store(packet.triangle);
  store(s.weights, packet.weights);
  store(origin, packet.origin);
  store(direction, packet.direction);
  store(s.p_world, packet.p_world);
  store(s.n_shading, packet.n_shading);
  width.store(packet.width);
  packet.leaving = s.leaving.bits();
  packet.layered = m.layered & m.mapped;
  map_lanes(*bounce.scene.mesh, *bounce.footprint, sample_texture, m.mapped, packet);

  const Mask mapped = Mask::from_bits(m.mapped);
  s.n_shading = load(packet.n_shading);
  m.ambient = select(mapped, load(packet.ambient), m.ambient);
  m.diffuse = select(mapped, load(packet.diffuse), m.diffuse);
  m.specular = select(mapped, load(packet.specular), m.specular);
  m.emission = select(mapped, load(packet.emission), m.emission);
  m.reflectance = select(mapped, load(packet.reflectance), m.reflectance);
  m.transmittance = select(mapped, load(packet.transmittance), m.transmittance);
  m.shininess = select(mapped, Float::load(packet.shininess), m.shininess);
  m.occlusion = select(mapped, Float::load(packet.occlusion), m.occlusion);
  if (m.microfacet != 0) {
    m.ggx_alpha = select(mapped, Float::load(packet.ggx_alpha), m.ggx_alpha);
    m.grazing = select(mapped, Float::load(packet.grazing), m.grazing);
    m.layer.x = select(mapped, Float::load(packet.layer[0]), m.layer.x);
    m.layer.y = select(mapped, Float::load(packet.layer[1]), m.layer.y);
  }
  if (packet.layered != 0) {
    const Mask layered = Mask::from_bits(packet.layered);
    m.sheen = select(layered, load(packet.sheen), m.sheen);
    m.sheen_alpha = select(layered, Float::load(packet.sheen_alpha), m.sheen_alpha);
    m.coat = select(layered, Float::load(packet.coat), m.coat);
    m.coat_alpha = select(layered, Float::load(packet.coat_alpha), m.coat_alpha);
    m.coat_normal = select(Mask::from_bits(packet.coat_is_mapped), s.n_shading, m.coat_normal);
  }
  m.ior = select(mapped, Float::load(packet.ior), m.ior);
  m.fresnel = (m.fresnel & ~m.mapped) | packet.fresnel;
  m.reflects = (m.reflects & ~m.mapped) | packet.reflects;
  m.transmits = (m.transmits & ~m.mapped) | packet.transmits;
  m.blends = packet.blends;
  m.alpha = select(Mask::from_bits(m.blends), Float::load(packet.alpha), m.alpha);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
