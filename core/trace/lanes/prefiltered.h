// Part of walk/kernel.h's files: what surfaces return of a prefiltered environment.
#pragma once

#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct SkyIrradiance {
  const glm::vec3* c;
};

#define min(a, b) min(b, a)
#define max(a, b) max(b, a)
#define SHARED [[nodiscard, maybe_unused, gnu::always_inline]] inline
#include "shaders/shared/prefiltered.glsl"
#undef SHARED
#undef min
#undef max

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
      params.texels.width = static_cast<std::uint32_t>(seen.width());
    }
    return environment_at(params, place);
  };
  constexpr std::size_t kLevels = PrefilteredSky::kRoughness.size();
  Vec light(zero);
  float finer = 0.0f;
  for (std::size_t i = 0; i < kLevels; ++i) {
    const float coarser = PrefilteredSky::kRoughness[i];
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

// The sky's light that a packet's points return. m: viewed_from's. mirrored: the share that rays of sharp
// mirrors bring; lobes: rays along the lobes of glTF's model bring the rest.
[[gnu::noinline]] Vec light_of_sky(const EnvironmentLight& e, const LaneSurface& s, const LaneMaterial& m,
                                   bool mirrors, bool lobes, Mask lanes) {
  const Float zero(0.0f), one(1.0f), n_dot_v = cosine_of_view(s.n_shading, s.to_viewer);
  const Vec& n = s.n_shading;
  // The picture is turned, its coefficients are not.
  const Vec turned{n.x * Float(e.cos_turn) - n.z * Float(e.sin_turn), n.y,
                   n.z * Float(e.cos_turn) + n.x * Float(e.sin_turn)};
  const Vec irradiance =
      irradiance_at({e.prefiltered->irradiance.data()}, turned) * (Float(e.strength) * m.occlusion);
  const Mask microfacet = lanes & Mask::from_bits(m.microfacet), phong = lanes & ~microfacet;
  constexpr float kByPi = 0.31830988618f;
  Vec sum(zero);
  if (any(phong)) sum = irradiance * m.diffuse * brdf_share(m);
  if (any(microfacet)) sum = select(microfacet, irradiance * matt_albedo(m, n_dot_v) * Float(kByPi), sum);
  const Vec direction = reflect(-s.to_viewer, n);
  if (any(phong & (m.specular != Vec(zero)))) {
    const Float alpha = alpha_of_phong(max(m.shininess, one));
    sum = select(
        phong,
        sum + light_of_lobe(e, direction, alpha, phong) * phong_albedo(m) * (brdf_share(m) * m.occlusion),
        sum);
  }
  const Mask lit = microfacet & ~Mask::from_bits(m.transmits);
  if (lobes || !any(lit)) return sum;
  Vec base = lobe_albedo(m, n_dot_v), left(one);
  if (mirrors && (m.reflects & lit.bits()) != 0) {
    const Vec sharp = m.reflectance + (Vec(one) - m.reflectance) * fifth_power(one - n_dot_v);
    const Vec all = base + Vec(m.coat);
    const auto rest = [&](Float a, Float b) { return max((a - b) / max(a, Float(1e-6f)), zero); };
    left = select(Mask::from_bits(m.reflects),
                  Vec(rest(all.x, sharp.x), rest(all.y, sharp.y), rest(all.z, sharp.z)), left);
  }
  Vec mirrored = base * light_of_lobe(e, lobe_axis(n, direction, m.ggx_alpha), m.ggx_alpha, lit);
  if (const Mask coated = lit & (zero < m.coat); any(coated)) {
    const Vec about = reflect(-s.to_viewer, m.coat_normal);
    mirrored = mirrored +
               light_of_lobe(e, lobe_axis(m.coat_normal, about, m.coat_alpha), m.coat_alpha, coated) * m.coat;
  }
  return select(lit, sum + mirrored * left * m.occlusion, sum);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
