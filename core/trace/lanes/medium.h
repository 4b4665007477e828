// Part of walk/kernel.h's files: light that goes through a coloured medium (Beer and Lambert). What a
// material encloses begins where a ray is refracted into it and ends where one meets it from behind.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The media on both sides of the surfaces that a packet meets: a material's index, or kNoMedium.
struct LaneMedia {
  Int here{kNoMedium}, beyond{kNoMedium};
};

// Not inlined: few scenes have a medium.
[[gnu::noinline]] LaneMedia media_at(const Bounce& bounce, Int of_ray, Int material, const LaneSurface& s,
                                     Float ior, Mask lanes) {
  Mask own = Mask::from_bits(0);
  for_each_distinct(material, lanes, [&](std::uint32_t index, Mask same) {
    if (bounce.scene.materials[index].attenuates()) own = own | same;
  });
  const Int none(kNoMedium);
  const Int here = select(own & s.leaving, material, of_ray);
  // Walls without a thickness do not bend light, and the medium is the same behind them.
  const Mask thin = (ior == Float(1.0f)) & ~own;
  return {here, select(thin, here, select(own & ~s.leaving, material, none))};
}

// The share of light that is left after `length` in the medium.
[[gnu::noinline]] Vec attenuation(const Bounce& bounce, Int medium, Float length, Mask lanes) {
  Vec left(Float(1.0f));
  for_each_distinct(medium, lanes & ~(medium == Int(kNoMedium)), [&](std::uint32_t index, Mask same) {
    const Material& m = bounce.scene.materials[index];
    const Float share = length / Float(m.attenuation_distance);
    const auto of = [&](float color) { return color > 0.0f ? power(Float(color), share) : Float(0.0f); };
    left = select(same, Vec(of(m.attenuation_color.x), of(m.attenuation_color.y), of(m.attenuation_color.z)),
                  left);
  });
  return left;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
