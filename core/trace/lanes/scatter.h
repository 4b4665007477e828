// Part of walk/kernel.h's files: mirrored and refracted rays. Dielectrics share by Fresnel's equations
// (beyond the critical angle all is mirrored); opaque mirrors have a constant reflectance or Schlick's.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/medium.h"
#include "core/trace/lanes/pixels.h"
#include "core/trace/lanes/surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// About the shading normal, unless that sends the ray into the surface; then about the geometric one.
inline Vec mirrored(const LaneSurface& s) {
  const Vec direction = reflect(-s.to_viewer, s.n_shading);
  const Mask good = Float(0.0f) < dot(direction, s.n_geometric);
  return select(good, direction, reflect(-s.to_viewer, s.n_geometric));
}

// A direction of the lobe about the mirrored one, (n + 1) / (2 pi) cos^n; the mirrored direction itself where
// n is 0. `lanes` loses those that would go into the surface.
inline Vec spread(const LaneSurface& s, const Vec& direction, Float gloss, const vec2& square, Mask& lanes) {
  const Float zero(0.0f), one(1.0f);
  const Mask sharp = gloss == zero;
  const vec2 disc = disc_of_square(square);
  const Float rho2 = min(disc.x * disc.x + disc.y * disc.y, Float(0x1.fffffep-1f));
  const Float cosine = power(one - rho2, one / (gloss + one));
  const Float sine = sqrt(max(one - cosine * cosine, zero));
  const Float across = select(Float(1e-12f) < rho2, sine / sqrt(rho2), zero);
  const Vec spread_out = around(direction, {disc.x * across, disc.y * across, cosine});
  lanes = lanes & (sharp | (zero < dot(spread_out, s.n_geometric)));
  return select(sharp, direction, spread_out);
}

// As glm::refract: `inverse` is 1 / eta; zero beyond the critical angle.
inline Vec refract(const Vec& incoming, const Vec& n, Float inverse) {
  const Float zero(0.0f), one(1.0f);
  const Float cosine = dot(n, incoming);
  const Float k = one - inverse * inverse * (one - cosine * cosine);
  const Vec through = incoming * inverse - n * (inverse * cosine + sqrt(k));
  return select(zero <= k, through, Vec(zero));
}

inline Vec refracted(const LaneSurface& s, Float eta) {
  const Float inverse = Float(1.0f) / eta;
  const Vec direction = refract(-s.to_viewer, s.n_shading, inverse);
  const Mask good = dot(direction, s.n_geometric) < Float(0.0f);
  return select(good, direction, refract(-s.to_viewer, s.n_geometric, inverse));
}

// Share of unpolarised light that a smooth dielectric mirrors. eta: index of the side the light goes to over
// the side it comes from.
inline Float fresnel_dielectric(Float cos_in, Float eta) {
  const Float one(1.0f);
  const Float sin2_out = (one - cos_in * cos_in) / (eta * eta);
  const Float cos_out = sqrt(one - sin2_out);
  const Float parallel = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  const Float perpendicular = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  return select(one <= sin2_out, one, Float(0.5f) * (parallel * parallel + perpendicular * perpendicular));
}

// Shares of the light at a glass surface. 1 - kept, times the transmittance, goes through.
struct GlassMirror {
  Vec mirrored;  // by the glass, and by the metal where the surface is partly metal
  Float kept;    // mirrored by the glass, in its brightest colour
};

// Walls of glTF's model that do not bend light.
inline Mask is_thin(const LaneMaterial& m) {
  return Mask::from_bits(m.microfacet) & (m.ior == Float(1.0f));
}

// By Fresnel's equations; of glTF's model from the surface's F0 to its F90 (KHR_materials_specular, and a
// metal's part) as they rise from ((ior - 1) / (ior + 1))^2 to 1. Thin walls mirror by Schlick's formula.
inline GlassMirror glass_mirror(const LaneMaterial& m, Float cosine, Float eta) {
  const Float zero(0.0f), one(1.0f), fresnel = fresnel_dielectric(cosine, eta);
  if (m.microfacet == 0) return {Vec(fresnel), fresnel};
  const Mask gltf = Mask::from_bits(m.microfacet);
  const Float root = (m.ior - one) / (m.ior + one), f0 = root * root;
  const Float away = one - cosine, away2 = away * away;
  const Float rise =
      select(is_thin(m), away2 * away2 * away, max(fresnel - f0, zero) / max(one - f0, Float(1e-6f)));
  const auto risen = [&](Float from, Float to) { return select(gltf, from + (to - from) * rise, fresnel); };
  return {Vec(risen(m.specular.x, m.grazing), risen(m.specular.y, m.grazing), risen(m.specular.z, m.grazing)),
          risen(m.layer.x, m.layer.y)};
}

inline void put(const Vec& v, float* const (&columns)[3], std::size_t i) {
  v.x.store(columns[0] + i);
  v.y.store(columns[1] + i);
  v.z.store(columns[2] + i);
}

// Appends to the queue what the rays of `lanes` carry, and their pixels; with append(), the rays.
inline void append_light(const Vec& light, Int pixel, Mask lanes, RayQueue& queue) {
  const std::size_t i = queue.size;
  store_packed(queue.light[0] + i, light.x, lanes);
  store_packed(queue.light[1] + i, light.y, lanes);
  store_packed(queue.light[2] + i, light.z, lanes);
  store_packed(queue.pixel + i, pixel, lanes);
  queue.size += as_size(__builtin_popcount(lanes.bits()));
}

inline void append(const Vec& origin, const Vec& direction, const Vec& light, Int pixel, Mask lanes,
                   RayQueue& queue) {
  const std::size_t i = queue.size;
  store_packed(queue.origin[0] + i, origin.x, lanes);
  store_packed(queue.origin[1] + i, origin.y, lanes);
  store_packed(queue.origin[2] + i, origin.z, lanes);
  store_packed(queue.direction[0] + i, direction.x, lanes);
  store_packed(queue.direction[1] + i, direction.y, lanes);
  store_packed(queue.direction[2] + i, direction.z, lanes);
  append_light(light, pixel, lanes, queue);
}

// The same for shadow rays that leave the surface.
inline void append_shadow_ray(const LaneSurface& s, const Vec& origin, const Vec& direction, const Vec& light,
                              Int pixel, Mask lanes, RayQueue& queue) {
  if (queue.medium) store_packed(queue.medium + queue.size, s.medium, lanes);
  append(origin, direction, light, pixel, lanes, queue);
}

// Appends those rays that are worth `least` in some colour. `medium`: what they go through; null where no
// material has one.
inline void follow(const LaneSurface& s, const Vec& direction, const Vec& throughput, Int pixel, Mask lanes,
                   float least, RayQueue& queue, const Int* medium, Float density = Float(0.0f)) {
  const Mask worth = lanes & ~(largest(throughput) < Float(least));
  if (worth.bits() == 0) return;
  if (queue.density) store_packed(queue.density + queue.size, density, worth);
  if (queue.width) store_packed(queue.width + queue.size, s.width, worth);
  if (queue.way) store_packed(queue.way + queue.size, s.way, worth);
  if (medium) store_packed(queue.medium + queue.size, *medium, worth);
  append(offset_origin(s, direction), direction, throughput, pixel, worth, queue);
}

// One direction a point along the lobe of glTF's reflection model, by the density of visible normals
// (lobe.h).
struct LaneLobe {
  Mask lanes = Mask::from_bits(0);  // the points that have one
  Vec facet{Float(0.0f)};           // unit normal of the microfacet
  Vec direction{Float(0.0f)};       // unit
  Vec throughput{Float(0.0f)};      // share of the light from there
  Float unshadowed{0.0f};           // the part of it that is not Fresnel's
  Float density{0.0f};              // per steradian; 0: no other method finds this light
  Float counted{0.0f};              // what reflected_light weighs the lobe's density with
  Mask rough = Mask::from_bits(0);  // the points whose lobe mirrors no sharp image
};

// The pixels of the lobe's rays (kSampledPixels).
inline Int lobe_pixel(const Bounce& bounce, const LaneLobe& lobe, Int pixel) {
  return select(lobe.rough, sampled_pixel(bounce, pixel), pixel);
}

// Rays through a surface that blends, with what it leaves of the light from behind.
inline void go_straight_on(const LaneSurface& s, const LaneMaterial& m, const Vec& throughput, Int pixel,
                           Mask lanes, const Bounce& bounce, const LaneMedia* media) {
  follow(s, -s.to_viewer, throughput * (Float(1.0f) - m.alpha), pixel, lanes & Mask::from_bits(m.blends),
         bounce.options->throughput_cutoff, *bounce.straight, media ? &media->here : nullptr, s.density);
}

// The direction that a facet of the lobe bends the light from the viewer to; zero: there is no way through.
inline Vec through_facet(const LaneSurface& s, const LaneMaterial& m, const LaneLobe& lobe, Float eta) {
  const Float zero(0.0f), two(2.0f);
  const Vec passed = lobe.direction - s.n_shading * (two * dot(s.n_shading, lobe.direction));
  const Vec bent = select(is_thin(m), passed, refract(-s.to_viewer, lobe.facet, Float(1.0f) / eta));
  return select(dot(bent, s.n_geometric) < zero, bent, Vec(zero));
}

inline Float eta_of(const LaneSurface& s, const LaneMaterial& m) {
  return select(s.leaving, Float(1.0f) / m.ior, m.ior);
}

// Glass: sharp, or about the lobe's facets where it is rough. An infinitely thin wall of glTF's model (ior 1)
// mirrors by Schlick's formula, and lets light pass without bending it.
template <bool kSampled>
[[gnu::noinline]] void scatter_glass(const LaneSurface& s, const LaneMaterial& m, const Vec& own,
                                     const LaneLobe& lobe, const SampledPixel* sampling, Int pixel,
                                     Mask lanes, const Bounce& bounce, const LaneMedia* media) {
  const Float zero(0.0f), one(1.0f);
  const float least = bounce.options->throughput_cutoff;
  const Float eta = eta_of(s, m);
  Float cos_in = clamp(dot(s.n_shading, s.to_viewer), 0.0f, 1.0f), left = one;
  Vec through = refracted(s, eta), direction = mirrored(s);
  Mask mirrors = lanes;
  if constexpr (kSampled) {
    if ((m.glossy & lanes.bits()) != 0 && bounce.options->glossy == Glossy::sampled)
      direction = spread(s, direction, m.gloss,
                         sample_2d(*sampling, bounce.dimension + shared::kMirrorDimension), mirrors);
    const Mask rough = lobe.lanes & (Float(shared::kLeastAlpha) < m.ggx_alpha);
    if (rough.bits() != 0) {
      cos_in = select(rough, clamp(dot(lobe.facet, s.to_viewer), 0.0f, 1.0f), cos_in);
      through = select(rough, through_facet(s, m, lobe, eta), through);
      direction = select(rough, lobe.direction, direction);
      left = select(rough, lobe.unshadowed, left);
    }
  }
  // Where the two normals disagree there may be no way through although Fresnel has a share for it.
  const Mask all = through == Vec(zero);
  const GlassMirror mirror = glass_mirror(m, cos_in, eta);
  const Vec mirror_share = select(all, Vec(one), mirror.mirrored);
  // Rays through glass find what shadow rays do only where these pass glass. Straight ones pass also where
  // the bent one is mirrored whole: there the mirrored ray finds it again.
  const Float found_through_glass = bounce.options->glass_shadows == GlassShadows::tinted ? s.density : zero;
  follow(s, through, own * (select(all, zero, one - mirror.kept) * left) * m.transmittance, pixel, lanes,
         least, *bounce.refracted, media ? &media->beyond : nullptr, found_through_glass);
  follow(s, direction, own * mirror_share * left, pixel, mirrors, least, *bounce.mirrored,
         media ? &media->here : nullptr, select(all, found_through_glass, zero));
}

template <bool kSampled>
inline void scatter(const LaneSurface& s, const LaneMaterial& m, const Vec& throughput, const LaneLobe& lobe,
                    const SampledPixel* sampling, Int pixel, Mask lanes, const Bounce& bounce,
                    const LaneMedia* media) {
  const Mask glass = lanes & Mask::from_bits(m.transmits),
             opaque =
                 lanes & Mask::from_bits(m.reflects & ~m.transmits & ~(bounce.lobes ? m.microfacet : 0u));
  const Vec own = m.blends != 0 ? throughput * m.alpha : throughput;
  const Int* const medium = media ? &media->here : nullptr;
  if (opaque.bits() != 0) {
    // Schlick 1994: (1 - cos)^5.
    const Float zero(0.0f), one(1.0f);
    const Float c = one - clamp(dot(s.n_shading, s.to_viewer), 0.0f, 1.0f), c2 = c * c;
    const Float grazing = select(Mask::from_bits(m.fresnel), c2 * c2 * c, zero);
    Mask mirrors = opaque;
    Vec direction = mirrored(s);
    Int of_mirror = pixel;
    if constexpr (kSampled)
      if ((m.glossy & opaque.bits()) != 0 && bounce.options->glossy == Glossy::sampled) {
        direction = spread(s, direction, m.gloss,
                           sample_2d(*sampling, bounce.dimension + shared::kMirrorDimension), mirrors);
        const Mask rough = Mask::from_bits(m.glossy) & (m.gloss < Float(kSharpGloss));
        of_mirror = select(rough, sampled_pixel(bounce, pixel), pixel);
      }
    follow(s, direction, own * (m.reflectance + (Vec(one) - m.reflectance) * grazing), of_mirror, mirrors,
           bounce.options->throughput_cutoff, *bounce.mirrored, medium);
  }
  if constexpr (kSampled) {
    const Mask glossy = lobe.lanes & ~glass & (lobe.throughput != Vec(0.0f));
    if (glossy.bits() != 0)
      follow(s, lobe.direction, own * lobe.throughput, lobe_pixel(bounce, lobe, pixel), glossy, 0.0f,
             *bounce.mirrored, medium, lobe.density);
  }
  if (glass.bits() != 0) scatter_glass<kSampled>(s, m, own, lobe, sampling, pixel, glass, bounce, media);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
