// Part of walk/kernel.h's files: mirrored and refracted rays. Dielectrics share by Fresnel's equations
// (beyond the critical angle all is mirrored); opaque mirrors have a constant reflectance or Schlick's.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/medium.h"
#include "core/trace/lanes/surface.h"

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

// Appends the rays of `lanes` to the queue.
inline void append(const Vec& origin, const Vec& direction, const Vec& light, Int pixel, Mask lanes,
                   RayQueue& queue) {
  const std::size_t i = queue.size;
  store_packed(queue.origin[0] + i, origin.x, lanes);
  store_packed(queue.origin[1] + i, origin.y, lanes);
  store_packed(queue.origin[2] + i, origin.z, lanes);
  store_packed(queue.direction[0] + i, direction.x, lanes);
  store_packed(queue.direction[1] + i, direction.y, lanes);
  store_packed(queue.direction[2] + i, direction.z, lanes);
  store_packed(queue.light[0] + i, light.x, lanes);
  store_packed(queue.light[1] + i, light.y, lanes);
  store_packed(queue.light[2] + i, light.z, lanes);
  store_packed(queue.pixel + i, pixel, lanes);
  queue.size += static_cast<std::size_t>(__builtin_popcount(lanes.bits()));
}

// Appends those rays that are worth `least` in some colour. `medium`: what they go through; null where no
// material has one.
inline void follow(const LaneSurface& s, const Vec& direction, const Vec& throughput, Int pixel, Mask lanes,
                   float least, RayQueue& queue, const Int* medium) {
  const Mask worth = lanes & ~(largest(throughput) < Float(least));
  if (worth.bits() == 0) return;
  if (queue.width) store_packed(queue.width + queue.size, s.width, worth);
  if (medium) store_packed(queue.medium + queue.size, *medium, worth);
  append(offset_origin(s, direction), direction, throughput, pixel, worth, queue);
}

// Rays through a surface that blends, with what it leaves of the light from behind.
inline void go_straight_on(const LaneSurface& s, const LaneMaterial& m, const Vec& throughput, Int pixel,
                           Mask lanes, const Bounce& bounce, const LaneMedia* media) {
  follow(s, -s.to_viewer, throughput * (Float(1.0f) - m.alpha), pixel, lanes & Mask::from_bits(m.blends),
         bounce.options->throughput_cutoff, *bounce.straight, media ? &media->here : nullptr);
}

template <bool kSampled>
inline void scatter(const LaneSurface& s, const LaneMaterial& m, const Vec& throughput,
                    const SampledPixel* sampling, Int pixel, Mask lanes, const Bounce& bounce,
                    const LaneMedia* media) {
  const unsigned alive = lanes.bits(), glass = m.transmits & alive,
                 opaque = m.reflects & ~m.transmits & alive;
  if ((m.blends & alive) != 0) go_straight_on(s, m, throughput, pixel, lanes, bounce, media);
  if ((glass | opaque) == 0) return;
  const Float zero(0.0f), one(1.0f);
  const Float cos_in = clamp(dot(s.n_shading, s.to_viewer), 0.0f, 1.0f);
  Vec mirror_share(zero), own = throughput;
  if (m.blends != 0) own = own * m.alpha;
  if (opaque != 0) {
    // Schlick 1994: (1 - cos)^5.
    const Float c = one - cos_in, c2 = c * c;
    const Float grazing = select(Mask::from_bits(m.fresnel), c2 * c2 * c, zero);
    mirror_share = m.reflectance + (Vec(one) - m.reflectance) * grazing;
  }
  if (glass != 0) {
    const Float eta = select(s.leaving, one / m.ior, m.ior);
    const Vec through = refracted(s, eta);
    // Where the two normals disagree there may be no way through although Fresnel has a share for it.
    const Float share = select(through == Vec(zero), one, fresnel_dielectric(cos_in, eta));
    mirror_share = select(Mask::from_bits(glass), Vec(share), mirror_share);
    follow(s, through, own * (one - share) * m.transmittance, pixel, Mask::from_bits(glass),
           bounce.options->throughput_cutoff, *bounce.refracted, media ? &media->beyond : nullptr);
  }
  Mask mirrors = Mask::from_bits(glass | opaque);
  Vec direction = mirrored(s);
  if constexpr (kSampled)
    if ((m.glossy & (glass | opaque)) != 0)
      direction = spread(s, direction, m.gloss,
                         sample_2d(*sampling, bounce.dimension + shared::kMirrorDimension), mirrors);
  follow(s, direction, own * mirror_share, pixel, mirrors, bounce.options->throughput_cutoff,
         *bounce.mirrored, media ? &media->here : nullptr);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
