// Part of walk/kernel.h's files: what surfaces return of a prefiltered environment.
#pragma once

#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A direction about +Z by the cosine: of `rays` of a sample, which are evenly spread and turned from sample
// to sample.
inline Vec sky_ray(int k, int rays, std::uint32_t sample) {
  constexpr float kGolden = 0.618034f;
  const float turn = kGolden * as_float(k) + 0.754878f * as_float(sample & 0xffffu);
  const float square = (as_float(k) + 0.5f) / as_float(rays);
  const Angle angle = angle_of(Float(turn) - floor(Float(turn)));
  const Float across = sqrt(Float(square));
  return {across * angle.cosine, across * angle.sine, sqrt(Float(1.0f - square))};
}

// The light that lobes of that alpha about `axis` see: between two levels of the sky.
[[gnu::noinline]] Vec light_of_lobe(const EnvironmentLight& e, const Vec& axis, Float alpha, Mask lanes) {
  const vec2 place = environment_place(params_of(e, lanes), axis);
  const Float roughness = sqrt(alpha), zero(0.0f), one(1.0f);
  const auto level = [&](std::size_t i, Mask those) {
    EnvironmentParams params = params_of(e, those);
    if (i > 0) {
      const Image<glm::vec3>& seen = e.prefiltered->levels[i - 1];
      params.size = seen.size();
      params.texels.pixels = seen.pixels().data();
      params.texels.width = as_uint32(seen.width());
    }
    return environment_at(params, place);
  };
  constexpr std::size_t kLevels = kSkyRoughness.size();
  Vec light(zero);
  float finer = 0.0f;
  for (std::size_t i = 0; i < kLevels; ++i) {
    const float coarser = kSkyRoughness[i];
    Mask between = lanes & (Float(finer) <= roughness);
    if (i + 1 < kLevels) between = between & (roughness < Float(coarser));
    if (any(between)) {
      const Float share = min((roughness - Float(finer)) / Float(coarser - finer), one);
      light = select(between, mix(level(i, between), level(i + 1, between), share), light);
    }
    finer = coarser;
  }
  return light;
}

// The sky's light that a packet's points return, by the directions that it comes from.
struct SkyLight {
  Vec matt;      // from all around the normal
  Vec mirrored;  // from about `axis`
  Vec axis;
};

// m: viewed_from's. mirrors: rays of sharp mirrors bring their share; lobes: rays along the lobes of glTF's
// model bring all that is mirrored.
[[gnu::noinline]] SkyLight light_of_sky(const EnvironmentLight& e, const LaneSurface& s,
                                        const LaneMaterial& m, bool mirrors, bool lobes, Mask lanes) {
  const Float zero(0.0f), one(1.0f), n_dot_v = cosine_of_view(s.n_shading, s.to_viewer);
  const Vec& n = s.n_shading;
  // The picture is turned, its coefficients are not.
  const Vec turned{n.x * Float(e.cos_turn) - n.z * Float(e.sin_turn), n.y,
                   n.z * Float(e.cos_turn) + n.x * Float(e.sin_turn)};
  const Vec irradiance =
      irradiance_at({e.prefiltered->irradiance.data()}, turned) * (Float(e.strength) * m.occlusion);
  const Mask microfacet = lanes & Mask::from_bits(m.microfacet), phong = lanes & ~microfacet;
  constexpr float kByPi = 0.31830988618f;
  const Vec direction = reflect(-s.to_viewer, n);
  SkyLight sky{Vec(zero), Vec(zero), direction};
  if (any(phong)) sky.matt = irradiance * m.diffuse * brdf_share(m);
  if (any(microfacet))
    sky.matt = select(microfacet, irradiance * matt_albedo(m, n_dot_v) * Float(kByPi), sky.matt);
  if (any(phong & (m.specular != Vec(zero)))) {
    const Float alpha = alpha_of_phong(max(m.shininess, one));
    sky.mirrored =
        select(phong, light_of_lobe(e, direction, alpha, phong) * phong_albedo(m) * brdf_share(m), Vec(zero));
  }
  const Mask lit = microfacet & ~Mask::from_bits(m.transmits);
  if (!lobes && any(lit)) {
    Vec left(one), base = lobe_albedo(m, n_dot_v);
    if (mirrors && (m.reflects & lit.bits()) != 0) {
      const Vec sharp = m.reflectance + (Vec(one) - m.reflectance) * fifth_power(one - n_dot_v);
      const Vec all = base + Vec(m.layers.coat);
      const auto rest = [&](Float a, Float b) { return max((a - b) / max(a, Float(1e-6f)), zero); };
      left = select(Mask::from_bits(m.reflects),
                    Vec(rest(all.x, sharp.x), rest(all.y, sharp.y), rest(all.z, sharp.z)), left);
    }
    sky.axis = select(lit, lobe_axis(n, direction, m.ggx_alpha), sky.axis);
    Vec mirrored = base * light_of_lobe(e, sky.axis, m.ggx_alpha, lit);
    if (const Mask coated = lit & (zero < m.layers.coat); any(coated)) {
      const Vec about = reflect(-s.to_viewer, m.coat_normal);
      const Float alpha = coat_alpha(m.layers);
      mirrored =
          mirrored + light_of_lobe(e, lobe_axis(m.coat_normal, about, alpha), alpha, coated) * m.layers.coat;
    }
    sky.mirrored = select(lit, mirrored * left, sky.mirrored);
  }
  sky.mirrored = sky.mirrored * m.occlusion;
  return sky;
}

// Shadow rays that carry the sky's light in equal parts: one along the mirrored light's axis, the others by
// the cosine about the normal, the same ones at all points of a sample.
[[gnu::noinline]] void hide_sky(const Bounce& bounce, const LaneSurface& s, const SkyLight& sky,
                                const Vec& throughput, Int pixel, Mask lanes) {
  const auto fire = [&](const Vec& direction, const Vec& light) {
    const Mask lit = lanes & (light != Vec(0.0f)) & (Float(0.0f) < dot(direction, s.n_geometric)) &
                     ~(largest(light) < Float(bounce.options->throughput_cutoff));
    if (any(lit))
      append_shadow_ray(s, offset_origin(s, direction), direction, light, pixel, lit, *bounce.sky);
  };
  fire(sky.axis, throughput * sky.mirrored);
  const int rays = bounce.options->sky_occlusion;
  const Vec part = throughput * sky.matt * Float(1.0f / as_float(rays));
  for (int k = 0; k < rays; ++k) {
    fire(around(s.n_shading, sky_ray(k, rays, bounce.options->sampling.index)), part);
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
