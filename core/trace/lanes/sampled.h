// Part of walk/kernel.h's files: what the filter of sampled light knows of the points that the camera sees.
#pragma once

#include "core/denoise/sampled_point.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The share of light from all around that the point returns by what is sampled. m: viewed_from's.
inline Vec sampled_albedo(const LaneSurface& s, const LaneMaterial& m) {
  const Float n_dot_v = cosine_of_view(s.n_shading, s.to_viewer);
  const Mask microfacet = Mask::from_bits(m.microfacet);
  Vec albedo = (m.diffuse * Float(shared::kPi) + phong_albedo(m)) * brdf_share(m) +
               select(Mask::from_bits(m.glossy), m.reflectance, Vec(Float(0.0f)));
  if (any(microfacet))
    albedo = select(microfacet, matt_albedo(m, n_dot_v) + lobe_albedo(m, n_dot_v) + Vec(m.coat), albedo);
  return m.blends != 0 ? albedo * m.alpha : albedo;
}

// Writes the points of a packet. way: from the eye.
[[gnu::noinline]] void write_points(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                    const Vec& way, Int pixels, Mask lanes) {
  alignas(64) std::uint32_t pixel[kWidth];
  alignas(64) float values[7][kWidth];
  const Vec albedo = sampled_albedo(s, m);
  const Float all[7] = {albedo.x,      albedo.y,      albedo.z,           s.n_shading.x,
                        s.n_shading.y, s.n_shading.z, sqrt(dot(way, way))};
  for (int k = 0; k < 7; ++k) all[k].store(values[k]);
  pixels.store(pixel);
  for (unsigned waiting = lanes.bits(); waiting != 0; waiting &= waiting - 1) {
    const int lane = __builtin_ctz(waiting);
    SampledPoint& point = bounce.points[pixel[lane]];
    point.albedo = {values[0][lane], values[1][lane], values[2][lane]};
    point.normal = {values[3][lane], values[4][lane], values[5][lane]};
    point.distance = values[6][lane];
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
