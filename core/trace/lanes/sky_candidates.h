// Part of walk/kernel.h's files: the environment's sample of a point, chosen among several candidates.
#pragma once

#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/terminator.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Directions that the environment's light is looked up in for each shadow ray; the ray is sent along one of
// them, likelier along one that brings more light (resampled importance sampling: Talbot, Cline and Egbert
// 2005). Where nothing blocks the light, the result is the mean of all candidates. This number, among 1, 2,
// 4 and 8, has little noise in a given time, also in shadow (docs/environment.md).
constexpr std::size_t kSkyCandidates = 4;

// How many of the environment's samples the balance heuristic counts, times their density.
inline Float density_of_candidates(Float density) {
  return Float(as_float(kSkyCandidates)) * density;
}

// The light that a shadow ray carries.
struct SkyChoice {
  Vec to_light, carried;  // carried: zero where no candidate brings light
};

[[gnu::noinline]] SkyChoice choose_from_sky(const Bounce& bounce, ShadowStarts& starts, const LaneSurface& s,
                                            const LaneMaterial& m, const Vec& throughput, Float lobe,
                                            const SampledPixel& sampling, Mask lanes) {
  constexpr auto kCount = as_uint32(kSkyCandidates);
  const std::uint32_t count = bounce.one_candidate ? 1 : kCount;
  const std::uint32_t dimension = bounce.dimension + shared::kEnvironmentDimension;
  vec2 number[kCount];
  SampledPixel of_candidate = sampling;
  of_candidate.sampling.count *= count;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    of_candidate.sampling.index = sampling.sampling.index * count + k;
    number[k] = sample_2d(of_candidate, dimension);
  }
  EnvironmentSample sample[kCount];
  sample_directions(*bounce.environment, number, lanes, sample);
  Vec returned[kCount];
  Float weight[kCount], sum[kCount], all(0.0f);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec& to_light = sample[k].direction;
    const Incident incident{to_light, Vec(1.0f), to_light, density_of_candidates(sample[k].density)};
    const Mask faces = lanes & starts.faces_light(to_light);
    returned[k] = reflected_light(m, incident, s.n_shading, s.to_viewer, faces, lobe);
    if (bounce.options->terminator == Terminator::smoothed)
      returned[k] = returned[k] * terminator_factor(s.n_shading, s.n_geometric, to_light);
    returned[k] = throughput * returned[k] * brdf_share(m);
    const Float light = brightness_at(*bounce.environment, sample[k].place, faces) / sample[k].density;
    weight[k] = select(faces, luminance(returned[k]) * light, Float(0.0f));
    sum[k] = all = all + weight[k];
  }
  const Float at = all * sample_2d(sampling, bounce.dimension + shared::kEnvironmentChoiceDimension).x;
  Mask waiting = lanes & (Float(0.0f) < all);
  SkyChoice choice{sample[0].direction, Vec(0.0f)};
  EnvironmentSample chosen = sample[0];
  const Float mean = all / Float(as_float(count));
  for (std::uint32_t k = 0; k < count; ++k) {
    const Mask here = waiting & (at < sum[k]);
    waiting = waiting & ~here;
    chosen.direction = select(here, sample[k].direction, chosen.direction);
    chosen.density = select(here, sample[k].density, chosen.density);
    chosen.place.x = select(here, sample[k].place.x, chosen.place.x);
    chosen.place.y = select(here, sample[k].place.y, chosen.place.y);
    choice.carried = select(here, returned[k] * (mean / weight[k]), choice.carried);
  }
  const Mask lit = choice.carried != Vec(0.0f);
  choice.to_light = chosen.direction;
  choice.carried =
      select(lit, choice.carried * light_of_sample(*bounce.environment, chosen.place, chosen.density, lit),
             Vec(0.0f));
  return choice;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
