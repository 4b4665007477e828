// Part of walk/kernel.h's files: what the filter of sampled light knows of the points that the camera sees,
// also in sharp mirrors and through glass.
#pragma once

#include "core/denoise/sampled_point.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/prefiltered.h"
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
    albedo =
        select(microfacet, matt_albedo(m, n_dot_v) + lobe_albedo(m, n_dot_v) + Vec(m.layers.coat), albedo);
  return m.blends != 0 ? albedo * m.alpha : albedo;
}

// The same under the environment, without its shadows, in units of its mean: what varies with the normal and
// the viewer is divided off, and what the filter smooths is little more than the shadows (as in Heitz et al.
// 2018, "Combining analytic direct illumination and stochastic shadows").
inline Vec returned_of_sky(const EnvironmentLight& e, const LaneSurface& s, const LaneMaterial& m,
                           const Vec& albedo, Mask lanes) {
  const glm::vec3& mean = e.prefiltered->irradiance[0];
  const float unit = shared::kOneByPi * e.strength * pinocchio::luminance(mean);
  if (!(unit > 0.0f)) return albedo;
  const SkyLight sky = light_of_sky(e, s, m, false, false, lanes);
  const Vec light = (sky.matt + sky.mirrored) * (m.alpha * Float(1.0f / unit));
  const Float least(0.1f);  // where the few coefficients know of no light
  return {max(light.x, albedo.x * least), max(light.y, albedo.y * least), max(light.z, albedo.z * least)};
}

// What the point returns of a light with a size where nothing is in its way, about: as if all of it came from
// the light's middle, with a highlight that is as much wider as the light is.
[[gnu::noinline]] Vec unshadowed_light(const LightParams& light, const LaneSurface& s,
                                       const LaneMaterial& m) {
  const Float zero(0.0f), one(1.0f);
  const Incident middle = incident_light(light, light.position, s.p_world);
  Float square(2.0f * light.size);  // of the sine of half the angle under which the light is seen
  if (light.kind != kLightDirectional) {
    const Vec way = Vec(light.position) - s.p_world;
    const Float r2(has_sides(light) ? shared::kOneByPi * area_of_sides(light) : light.size * light.size);
    square = r2 / max(dot(way, way), r2);
  }
  // Where a part of the light is below the horizon, the rest falls off with its square.
  const Float n_dot_l = dot(s.n_shading, middle.to_light), sine = sqrt(square),
              above = max(n_dot_l + sine, zero);
  const Float cosine = select(n_dot_l < sine, above * above / (Float(4.0f) * sine), n_dot_l);
  Vec share = m.diffuse * max(cosine, Float(0.02f));
  const Mask microfacet = Mask::from_bits(m.microfacet), phong = ~microfacet & (m.specular != Vec(zero)),
             rough = microfacet & (Float(kSharpAlpha) < m.ggx_alpha);
  if (any(phong)) {
    const Float exponent = max(m.shininess, one), wide = exponent / (one + Float(0.25f) * exponent * square);
    const Vec mirrored = s.n_shading * (Float(2.0f) * n_dot_l) - middle.to_light;
    const Float highlight = power(max(dot(mirrored, s.to_viewer), Float(1e-3f)), wide) * (wide / exponent);
    share = select(phong, share + m.specular * highlight, share);
  }
  if (any(rough)) {
    const Float alpha = sqrt(m.ggx_alpha * m.ggx_alpha + Float(0.125f) * square);
    const Float of_coat = coat_alpha(m.layers);
    const Float coat_rough = sqrt(of_coat * of_coat + Float(0.125f) * square);
    share = select(
        rough, share + lobe_light(m, alpha, coat_rough, s.n_shading, s.to_viewer, middle.to_light).reflected,
        share);
  }
  return middle.radiance * share;
}

// Calls add(point, lane) for the filter's points of a packet; others' rays were sent at random themselves.
template <class Add>
inline void for_each_point(const Bounce& bounce, Int pixels, Mask lanes, Add add) {
  alignas(64) std::uint32_t pixel[kWidth];
  pixels.store(pixel);
  for (unsigned waiting = lanes.bits(); waiting != 0; waiting &= waiting - 1) {
    const int lane = __builtin_ctz(waiting);
    if (pixel[lane] < kSampledPixels) add(bounce.points[pixel[lane]], lane);
  }
}

[[gnu::noinline]] void add_unshadowed(const Bounce& bounce, const Vec& light, Int pixels, Mask lanes) {
  alignas(64) float values[3][kWidth];
  light.x.store(values[0]);
  light.y.store(values[1]);
  light.z.store(values[2]);
  for_each_point(bounce, pixels, lanes, [&](SampledPoint& point, int lane) {
    point.lamp_albedo += glm::vec3(values[0][lane], values[1][lane], values[2][lane]);
  });
}

// Adds the points of a packet to those of their pixels. throughput: of the paths from the eye to the points.
[[gnu::noinline]] void add_points(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                  const Vec& throughput, Int pixels, Mask lanes) {
  lanes = lanes & (pixels < Int(kSampledPixels));  // the others are sampled themselves
  if (!any(lanes)) return;
  alignas(64) float values[9][kWidth];
  const Vec even = sampled_albedo(s, m);
  const bool under_sky = bounce.environment && bounce.environment->prefiltered;
  const Vec albedo =
      throughput * (under_sky ? returned_of_sky(*bounce.environment, s, m, even, lanes) : even);
  const Float all[9] = {albedo.x,      albedo.y,        albedo.z,
                        s.n_shading.x, s.n_shading.y,   s.n_shading.z,
                        s.way,         luminance(even), luminance(throughput * even)};
  for (int k = 0; k < 9; ++k) all[k].store(values[k]);
  for_each_point(bounce, pixels, lanes, [&](SampledPoint& point, int lane) {
    point.albedo += glm::vec3(values[0][lane], values[1][lane], values[2][lane]);
    if (!(point.shown < values[8][lane])) return;
    point.normal = {values[3][lane], values[4][lane], values[5][lane]};
    point.distance = values[6][lane];
    point.guide_albedo = values[7][lane];
    point.shown = values[8][lane];
  });
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
