// Part of walk/kernel.h's files: what surfaces return of a prefiltered environment.
#pragma once

#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Directions about +Z by the cosine, evenly spread. Each pixel has its own, spread together with its
// neighbours' (sampling.glsl): with the same directions at all pixels, the edges of overlapping shadows would
// show. Samples turn them; every fourth moves them in or out.
class SkyRays {
 public:
  SkyRays(const whole2& pixel, const Sampling& sampling, int rays) : rays_(Float(as_float(rays))) {
    const std::uint32_t seed = shared::mixed_bits(sampling.seed ^ 0x5ca1ab1eu);
    const vec2 moved = vec2(scrambled_sobol(z_order(pixel), Int(seed)) >> 8u) * (1.0f / 16777216.0f);
    turn_ = moved.x + Float(0.754878f * as_float(sampling.index & 0xffffu));
    const Float inside = moved.y + Float(0.569840f * as_float(sampling.index >> 2u & 0xffffu));
    inside_ = inside - floor(inside);
  }
  [[nodiscard]] Vec direction(int k) const {
    constexpr float kGolden = 0.618034f;
    const Float turn = turn_ + Float(kGolden * as_float(k)), square = (Float(as_float(k)) + inside_) / rays_;
    const Angle angle = angle_of(turn - floor(turn));
    const Float across = sqrt(square);
    return {across * angle.cosine, across * angle.sine, sqrt(Float(1.0f) - square)};
  }

 private:
  Float rays_, turn_, inside_;
};

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

constexpr float kLeastLobe = 0.01f;  // alpha; so that a lobe's weight stays finite

// The sky's light that a packet's points return, by the directions that it comes from.
struct SkyLight {
  Vec matt;      // from all around the normal
  Vec mirrored;  // from about `axis`
  Vec axis;
  Float alpha;  // of the lobe about it
  Vec albedo;   // of both, without a coat
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
  const Vec direction = reflect(-s.to_viewer, n);
  SkyLight sky{Vec(zero), Vec(zero), direction, max(m.ggx_alpha, Float(kLeastLobe)), Vec(zero)};
  if (any(phong)) {
    const Vec diffuse = m.diffuse * brdf_share(m);
    sky.albedo = diffuse * Float(shared::kPi);
    sky.matt = irradiance * diffuse;
  }
  if (any(microfacet)) {
    const Vec albedo = matt_albedo(m, n_dot_v);
    sky.albedo = select(microfacet, albedo, sky.albedo);
    sky.matt = select(microfacet, irradiance * albedo * Float(shared::kOneByPi), sky.matt);
  }
  if (any(phong & (m.specular != Vec(zero)))) {
    const Float alpha = alpha_of_phong(max(m.shininess, one));
    const Vec albedo = phong_albedo(m) * brdf_share(m);
    sky.alpha = select(phong, max(alpha, Float(kLeastLobe)), sky.alpha);
    sky.albedo = select(phong, sky.albedo + albedo, sky.albedo);
    sky.mirrored = select(phong, light_of_lobe(e, direction, alpha, phong) * albedo, Vec(zero));
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
    sky.albedo = select(lit, sky.albedo + base, sky.albedo);
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

// How much of a lobe of that alpha is about a direction, that along its axis being 1 / alpha^4: the density
// of microfacets (GGX) halfway between the two.
inline Float lobe_weight(Float alpha, const Vec& axis, const Vec& direction) {
  const Float one(1.0f), half2 = Float(0.5f) * (one + dot(axis, direction)), a2 = alpha * alpha;
  const Float bulk = one - half2 + a2 * half2;
  return one / (bulk * bulk);
}

// Shadow rays that carry the sky's light: one along the mirrored light's axis, the others by the cosine about
// the normal. These share matt light evenly, and mirrored light with the first by the lobe's width.
// The share that TraceOptions::sky_bounce keeps is added without a ray.
[[gnu::noinline]] void hide_sky(const Bounce& bounce, const LaneSurface& s, const SkyLight& sky,
                                const Vec& throughput, Int pixel, Mask lanes) {
  const Mask worth =
      lanes & ~(largest(throughput * (sky.matt + sky.mirrored)) < Float(bounce.options->throughput_cutoff));
  const auto fire = [&](const Vec& direction, const Vec& light) {
    const Mask lit = worth & (light != Vec(0.0f)) & (Float(0.0f) < dot(direction, s.n_geometric));
    if (any(lit))
      append_shadow_ray(s, offset_origin(s, direction), direction, light, pixel, lit, *bounce.sky);
  };
  const int rays = bounce.options->sky_occlusion;
  const SkyRays about(whole_picture_pixel(bounce, pixel), bounce.options->sampling, rays);
  const Vec one(Float(1.0f)), kept = min(sky.albedo, one) * Float(bounce.options->sky_bounce);
  const Vec hidden = one - kept;
  if (any(lanes & (kept != Vec(0.0f))))
    add_light(throughput * (sky.matt + sky.mirrored) * kept, pixel, lanes, bounce.traced);
  const Vec matt = throughput * sky.matt * hidden * Float(1.0f / as_float(rays));
  const Vec mirrored = throughput * sky.mirrored * hidden;
  if (!any(lanes & (mirrored != Vec(0.0f)))) {
    for (int k = 0; k < rays; ++k) fire(around(s.n_shading, about.direction(k)), matt);
    return;
  }
  const Float along_axis = lobe_weight(sky.alpha, sky.axis, sky.axis);
  Float all = along_axis;
  for (int k = 0; k < rays; ++k)
    all = all + lobe_weight(sky.alpha, sky.axis, around(s.n_shading, about.direction(k)));
  fire(sky.axis, mirrored * (along_axis / all));
  for (int k = 0; k < rays; ++k) {
    const Vec direction = around(s.n_shading, about.direction(k));
    fire(direction, matt + mirrored * (lobe_weight(sky.alpha, sky.axis, direction) / all));
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
