// Part of walk/kernel.h's files: the two directions that a point samples around itself: one of the
// environment's light, and one for light from other surfaces.
#pragma once

#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/lobe.h"
#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/terminator.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The factor on light from all around. Where Phong's coefficients are not a BRDF's, the lights hold their 1 /
// pi, and other light needs it here.
inline Float brdf_share(const LaneMaterial& m) {
  return select(Mask::from_bits(m.brdf), Float(1.0f), Float(0.31830988618f));
}

// A shadow ray towards one direction of the environment, with the light that it brings.
[[gnu::noinline]] void sample_environment(const Bounce& bounce, ShadowStarts& starts, const LaneSurface& s,
                                          const LaneMaterial& m, const Vec& throughput, const LaneLobe& lobe,
                                          const SampledPixel& sampling, Int pixel, Mask lanes) {
  SampleLanes packet{};
  const vec2 numbers = sample_2d(sampling, bounce.dimension + shared::kEnvironmentDimension);
  numbers.x.store(packet.number[0]);
  numbers.y.store(packet.number[1]);
  bounce.environment->sample(lanes.bits(), packet);
  const Vec direction = load(packet.direction);
  const Incident incident{direction, load(packet.light), direction, Float::load(packet.density)};
  Mask lit = lanes & starts.faces_light(incident.to_light) & (incident.radiance != Vec(0.0f));
  if (lit.bits() == 0) return;
  Vec carried =
      throughput * reflected_light(m, incident, s.n_shading, s.to_viewer, lit, lobe.counted) * brdf_share(m);
  if (bounce.options->terminator == Terminator::smoothed)
    carried = carried * terminator_factor(s.n_shading, s.n_geometric, incident.to_light);
  lit = lit & ~(largest(carried) < Float(bounce.options->throughput_cutoff));
  if (lit.bits() == 0) return;
  append(starts.origins(incident.to_light), incident.to_light, carried, pixel, lit, *bounce.sky);
  starts.append_ways_up(lit, *bounce.sky, *bounce.sky_ways_up);
}

// A shadow ray along the lobe where no ray follows it, with the environment's light.
[[gnu::noinline]] void sky_along_lobe(const Bounce& bounce, const LaneSurface& s, const LaneLobe& lobe,
                                      const Vec& own, Int pixel) {
  SampleLanes packet{};
  store(lobe.direction, packet.direction);
  bounce.environment->look_up(lobe.lanes.bits(), packet);
  const Float other = Float::load(packet.density);
  const Float counts = select(Float(0.0f) < lobe.density, lobe.density / (lobe.density + other), Float(1.0f));
  const Vec carried = own * lobe.throughput * load(packet.light) * counts;
  const Mask lit = lobe.lanes & (carried != Vec(0.0f));
  if (lit.bits() != 0)
    append(offset_origin(s, lobe.direction), lobe.direction, carried, pixel, lit, *bounce.sky);
}

// A ray towards light from other surfaces, by the cosine about the shading normal; none where that sends it
// into the surface.
[[gnu::noinline]] void scatter_diffuse(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                       const Vec& throughput, const SampledPixel& sampling, Int pixel,
                                       Mask lanes, const LaneMedia* media) {
  const Vec albedo = m.diffuse * (brdf_share(m) * Float(3.14159265359f));
  Vec light = throughput * albedo;
  lanes = lanes & (light != Vec(0.0f));
  if (lanes.bits() == 0) return;
  const vec2 disc = disc_of_square(sample_2d(sampling, bounce.dimension + shared::kDiffuseDimension));
  const Float up = sqrt(max(Float(1.0f) - (disc.x * disc.x + disc.y * disc.y), Float(0.0f)));
  const Vec direction = around(s.n_shading, {disc.x, disc.y, up});
  if (m.microfacet != 0) {
    const Float below = lobe_light(m, s.n_shading, s.to_viewer, direction).below;
    light = select(Mask::from_bits(m.microfacet), light * below, light);
  }
  follow(s, direction, light, pixel, lanes & (Float(0.0f) < dot(direction, s.n_geometric)),
         bounce.options->throughput_cutoff, *bounce.diffuse, media ? &media->here : nullptr);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
