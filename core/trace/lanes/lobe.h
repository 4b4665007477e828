// Part of walk/kernel.h's files: directions of the lobe of glTF's reflection model, and the lights that they
// meet.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The light that a facet of glass mirrors, as rays that follow it have it (scatter_glass).
[[gnu::noinline]] Vec mirrored_by_glass(const LaneSurface& s, const LaneMaterial& m, const LaneLobe& lobe) {
  const Float eta = eta_of(s, m), cosine = clamp(dot(lobe.facet, s.to_viewer), 0.0f, 1.0f);
  const Mask all = through_facet(s, m, lobe, eta) == Vec(0.0f);
  return select(all, Vec(1.0f), glass_mirror(m, cosine, eta).mirrored) * lobe.unshadowed;
}

// The lobes that are worth a ray. `own`: the paths' throughput.
[[gnu::noinline]] LaneLobe sample_lobe(const LaneSurface& s, const LaneMaterial& m, const Vec& own,
                                       const SampledPixel& sampling, Mask lanes, const Bounce& bounce) {
  const Float zero(0.0f), one(1.0f), two(2.0f);
  const Mask glass = Mask::from_bits(m.transmits), coated = zero < m.layers.coat;
  const Float base_dot_v = cosine_of_view(s.n_shading, s.to_viewer);
  LaneLobe lobe;
  lobe.lanes =
      lanes & Mask::from_bits(m.microfacet) &
      (glass | ~(largest(own) * mirrored_share(m, base_dot_v) < Float(bounce.options->throughput_cutoff)));
  vec2 number = sample_2d(sampling, bounce.dimension + shared::kMirrorDimension);
  Vec n = s.n_shading;
  Float alpha = m.ggx_alpha, n_dot_v = base_dot_v;
  if (coated.bits() != 0) {
    // One random number chooses the layer; what is left of it, scaled to [0, 1), is used again.
    const Float chance = coat_chance(m, m.ggx_alpha, base_dot_v);
    const Mask by_coat = coated & (number.x < chance);
    const Float rest = select(by_coat, number.x / chance, (number.x - chance) / (one - chance));
    number.x = select(coated, clamp(rest, 0.0f, 0x1.fffffep-1f), number.x);
    n = select(by_coat, m.coat_normal, n);
    alpha = select(by_coat, coat_alpha(m.layers), alpha);
    n_dot_v = cosine_of_view(n, s.to_viewer);
  }
  const vec2 disc = disc_of_square(number);
  const Across axes = across(n);
  const Vec v{dot(axes.t, s.to_viewer), dot(axes.u, s.to_viewer), n_dot_v};
  const Vec h = visible_normal(v, alpha, disc);
  lobe.facet = axes.t * h.x + axes.u * h.y + n * h.z;
  const Float v_dot_h = dot(s.to_viewer, lobe.facet);
  Vec direction = lobe.facet * (two * v_dot_h) - s.to_viewer;
  const Float n_dot_l = dot(n, direction), outside = dot(direction, s.n_geometric);
  lobe.unshadowed =
      select(zero < n_dot_l,
             two * n_dot_l * ggx_visibility(n_dot_l, n_dot_v, alpha) / ggx_viewed(n_dot_v, alpha), zero);
  lobe.throughput = schlick(m.specular, m.grazing, v_dot_h) * lobe.unshadowed;
  Float density = Float(0.5f) * ggx(h.z, h.x * h.x + h.y * h.y, alpha) * ggx_viewed(n_dot_v, alpha);
  if (coated.bits() != 0) {
    const LobeLight both =
        lobe_light(m, m.ggx_alpha, coat_alpha(m.layers), s.n_shading, s.to_viewer, direction);
    lobe.throughput =
        select(coated, select(zero < n_dot_l, both.reflected / both.density, Vec(zero)), lobe.throughput);
    density = select(coated, both.density, density);
  }
  // Into the surface, by a normal that is not the triangle's: the direction's mirror image lies outside.
  const Mask inwards = ~(zero < outside);
  lobe.direction = select(inwards, direction - s.n_geometric * (two * outside), direction);
  if (const Mask bare = glass & ~coated; bare.bits() != 0)
    lobe.throughput = select(bare, mirrored_by_glass(s, m, lobe), lobe.throughput);
  lobe.density = select(inwards | glass, zero, density);
  lobe.rough = lobe.lanes & ~glass & (Float(kSharpAlpha) < alpha);
  lobe.counted = select(lobe.lanes, select(glass, Float(kAlone), one), zero);
  return lobe;
}

// Fires shadow rays along the lobe at the casting lights with a size that it meets.
[[gnu::noinline]] void light_along_lobe(const Bounce& bounce, const LaneSurface& s, const LaneLobe& lobe,
                                        const Vec& own, Int pixel) {
  for (std::size_t i = 0; i < bounce.light_count; ++i) {
    const BounceLight& light = bounce.lights[i];
    if (!light.has_size || light.slot < 0) continue;
    const bool far = light.params.kind == shared::kLightDirectional;
    const Meeting m = meet_light(light.params, s.p_world, lobe.direction);
    const Float combined = lobe.density + m.incident.density;
    const Float counts = select(Float(0.0f) < lobe.density, lobe.density / combined, Float(1.0f));
    const Vec carried = own * lobe.throughput * m.incident.radiance * (m.incident.density * counts);
    const Mask lit = lobe.lanes & m.met & (carried != Vec(0.0f));
    if (lit.bits() == 0) continue;
    const Vec origin = offset_origin(s, lobe.direction);
    append_shadow_ray(s, origin, far ? lobe.direction : m.incident.target - origin, carried, pixel, lit,
                      far ? *bounce.sky : *bounce.lobe_lights);
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
