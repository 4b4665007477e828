// Part of trace/kernel.h's files: what a point samples of all directions around it: one of the environment,
// where its light comes from, and one in which light from other surfaces is looked for.
#pragma once

#include "core/trace/environment_light.h"
#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/sampling.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/sized_light.h"
#include "core/trace/lanes/terminator.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// What of light from all around is reflected where Phong's coefficients are not a BRDF's: their 1 / pi is
// counted to the lights.
inline Float brdf_share(const LaneMaterial& m) {
  return select(Mask::from_bits(m.brdf), Float(1.0f), Float(0.31830988618f));
}

// A shadow ray towards one direction of the environment, with the light that it brings.
[[gnu::noinline]] void ask_environment(const Bounce& bounce, ShadowStarts& starts, const LaneSurface& s,
                                       const LaneMaterial& m, const Vec& throughput,
                                       const LaneSampling& sampling, Int pixel, Mask lanes) {
  SampleLanes packet{};
  const LanePoint numbers = sample_2d(sampling, bounce.dimension + shared::kEnvironmentDimension);
  numbers.x.store(packet.number[0]);
  numbers.y.store(packet.number[1]);
  bounce.environment->sample(lanes.bits(), packet);
  const Vec direction = load(packet.direction);
  const LaneIncident incident{direction, load(packet.light), direction};
  Mask lit = lanes & starts.faces_light(incident.to_light) & ~is_dark(incident.radiance);
  if (lit.bits() == 0) return;
  Vec carried = throughput * phong_light(m, incident, s, lit) * brdf_share(m);
  if (bounce.options->terminator == Terminator::smoothed)
    carried = carried * terminator_factor(s, incident.to_light);
  lit = lit & ~(largest(carried) < Float(bounce.options->throughput_cutoff));
  if (lit.bits() == 0) return;
  append(starts.origins(incident.to_light), incident.to_light, carried, pixel, lit, *bounce.sky);
  starts.ask_ways_up(lit, *bounce.sky, *bounce.sky_ways_up);
}

// A ray that looks for light from other surfaces, by the cosine about the shading normal; none where that
// sends it into the surface.
[[gnu::noinline]] void scatter_diffuse(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                       const Vec& throughput, const LaneSampling& sampling, Int pixel,
                                       Mask lanes, const LaneMedia* media) {
  const Vec albedo = m.diffuse * (brdf_share(m) * Float(3.14159265359f)), light = throughput * albedo;
  lanes = lanes & ~is_dark(light);
  if (lanes.bits() == 0) return;
  const LanePoint disc = disc_of_square(sample_2d(sampling, bounce.dimension + shared::kDiffuseDimension));
  const Float up = sqrt(max(Float(1.0f) - (disc.x * disc.x + disc.y * disc.y), Float(0.0f)));
  const Vec direction = around(s.n_shading, {disc.x, disc.y, up});
  follow(s, direction, light, pixel, lanes & (Float(0.0f) < dot(direction, s.n_geometric)),
         bounce.options->throughput_cutoff, *bounce.diffuse, media ? &media->here : nullptr);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
