// Part of walk/kernel.h's files: the two directions that a point samples around itself: one of the
// environment's light, and one for light from other surfaces.
#pragma once

#include "core/trace/lanes/lobe.h"
#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/prefiltered.h"
#include "core/trace/lanes/sky_candidates.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A shadow ray towards one direction of the environment, with the light that it brings.
[[gnu::noinline]] void sample_environment(const Bounce& bounce, ShadowStarts& starts, const LaneSurface& s,
                                          const LaneMaterial& m, const Vec& throughput, const LaneLobe& lobe,
                                          const SampledPixel& sampling, Int pixel, Mask lanes) {
  const SkyChoice choice = choose_from_sky(bounce, starts, s, m, throughput, lobe.counted, sampling, lanes);
  const Mask lit = lanes & starts.faces_light(choice.to_light) & (choice.carried != Vec(0.0f)) &
                   ~(largest(choice.carried) < Float(bounce.options->throughput_cutoff));
  if (lit.bits() == 0) return;
  append_shadow_ray(s, starts.origins(choice.to_light), choice.to_light, choice.carried, pixel, lit,
                    *bounce.sky);
  starts.append_ways_up(lit, *bounce.sky, *bounce.sky_ways_up);
}

// A shadow ray along the lobe where no ray follows it, with the environment's light.
[[gnu::noinline]] void sky_along_lobe(const Bounce& bounce, const LaneSurface& s, const LaneLobe& lobe,
                                      const Vec& own, Int pixel) {
  const Float other =
      density_of_candidates(density_of_light(*bounce.environment, lobe.direction, lobe.lanes));
  const Float counts = select(Float(0.0f) < lobe.density, lobe.density / (lobe.density + other), Float(1.0f));
  const Vec light = light_from_environment(*bounce.environment, lobe.direction, lobe.lanes);
  const Vec carried = own * lobe.throughput * light * counts;
  const Mask lit = lobe.lanes & (carried != Vec(0.0f));
  if (lit.bits() != 0)
    append_shadow_ray(s, offset_origin(s, lobe.direction), lobe.direction, carried, pixel, lit, *bounce.sky);
}

// A ray towards light from other surfaces, by the cosine about the shading normal; none where that sends it
// into the surface.
[[gnu::noinline]] void scatter_diffuse(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                       const Vec& throughput, const SampledPixel& sampling, Int pixel,
                                       Mask lanes, const LaneMedia* media) {
  const Vec albedo = m.diffuse * (brdf_share(m) * Float(shared::kPi));
  Vec light = throughput * albedo;
  lanes = lanes & (light != Vec(0.0f));
  if (lanes.bits() == 0) return;
  const vec2 disc = disc_of_square(sample_2d(sampling, bounce.dimension + shared::kDiffuseDimension));
  const Float up = sqrt(max(Float(1.0f) - (disc.x * disc.x + disc.y * disc.y), Float(0.0f)));
  const Vec direction = around(s.n_shading, {disc.x, disc.y, up});
  if (m.microfacet != 0) {
    const Float below =
        lobe_light(m, m.ggx_alpha, coat_alpha(m.layers), s.n_shading, s.to_viewer, direction).below;
    light = select(Mask::from_bits(m.microfacet), light * below, light);
  }
  follow(s, direction, light, pixel, lanes & (Float(0.0f) < dot(direction, s.n_geometric)),
         bounce.options->throughput_cutoff, *bounce.diffuse, media ? &media->here : nullptr);
}

// Finds where in the picture the rays of some packets go. Memory is requested for all of them at once.
template <std::size_t kCount>
inline void find_seen(const EnvironmentLight& e, const RayQueue& rays, std::size_t first,
                      const Mask (&missed)[kCount], vec2 (&place)[kCount]) {
  const auto at = [](Float share, int size) {
    return to_int(min(share * Float(as_float(size)), Float(as_float(size - 1))));
  };
  for (std::size_t k = 0; k < kCount; ++k) {
    if (!any(missed[k])) continue;
    place[k] = environment_place(params_of(e, missed[k]), Vec::load(rays.direction, first + k * kWidth));
    const Int texel = at(place[k].y, e.size.y) * Int(as_uint32(e.size.x)) + at(place[k].x, e.size.x);
    fetch(e.pixels, texel, missed[k]);
    if (rays.density) fetch(e.shares.columns, texel, missed[k]);
  }
}

// Adds the environment's light along rays that hit nothing. counts_samples: where the ray starts, a sample of
// the environment may have found the same light.
void add_environment(const EnvironmentLight& environment, bool counts_samples, const RayQueue& rays,
                     float* radiance) {
  constexpr std::size_t kAtOnce = 4;  // packets
  const Float zero(0.0f), one(1.0f);
  for (std::size_t first = 0; first < rays.size; first += kAtOnce * kWidth) {
    Mask missed[kAtOnce];
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      const std::size_t i = first + k * kWidth;
      missed[k] = i < rays.size
                      ? lanes_from(i, rays.size) & (Int::load(rays.triangle + i) == Int(kNoTriangle))
                      : Mask::from_bits(0);
    }
    vec2 place[kAtOnce];
    find_seen(environment, rays, first, missed, place);
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      if (!any(missed[k])) continue;
      const std::size_t i = first + k * kWidth;
      Vec light = environment_at(params_of(environment, missed[k]), place[k]);
      if (rays.density) {
        const Float density = Float::load(rays.density + i);
        light = select(density < zero, Vec(zero), light);
        const Mask both = counts_samples ? missed[k] & (zero < density) : Mask::from_bits(0);
        if (any(both)) {
          const Vec direction = Vec::load(rays.direction, i);
          const Float other = density_of_candidates(density_of_light(environment, direction, place[k], both));
          light = light * select(both, density / (density + other), one);
        }
      }
      add_light(Vec::load(rays.light, i) * light, rays.pixel + i, missed[k], radiance);
    }
  }
}

// Adds the environment to the tile's pixels that show nothing; alpha stays 0.
void paint_background(const EnvironmentLight& environment, const shared::ViewParams& view,
                      const PixelBox& tile, glm::vec4* color) {
  static_assert(kWidth <= 16);
  alignas(64) static constexpr std::uint32_t kLane[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};
  // Parallel rays have one direction: their steps move the origin.
  const Vec corner(view.corner), step_x(view.parallel ? glm::vec3(0.0f) : view.step_x),
      step_y(view.parallel ? glm::vec3(0.0f) : view.step_y);
  for (int y = tile.lo.y; y < tile.hi.y; ++y)
    for (int x = tile.lo.x; x < tile.hi.x; x += kWidth) {
      glm::vec4* const pixels = color + (as_size(y - tile.lo.y) << kTileBits) + as_size(x - tile.lo.x);
      const int count = tile.hi.x - x < kWidth ? tile.hi.x - x : kWidth;
      unsigned empty = 0;
      for (int i = 0; i < count; ++i) empty |= (pixels[i].a == 0.0f ? 1u : 0u) << i;
      if (empty == 0) continue;
      const Float column = Float(view.first.x) + to_float(Int::load(kLane) + Int(as_uint32(x)));
      const Float row(view.first.y + as_float(y));
      const Vec light = light_from_environment(environment, corner + step_x * column + step_y * row,
                                               Mask::from_bits(empty));
      alignas(64) float rgb[3][kWidth];
      light.x.store(rgb[0]);
      light.y.store(rgb[1]);
      light.z.store(rgb[2]);
      for (; empty != 0; empty &= empty - 1) {
        const int i = __builtin_ctz(empty);
        pixels[i] = glm::vec4(rgb[0][i], rgb[1][i], rgb[2][i], 0.0f);
      }
    }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
