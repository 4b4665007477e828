// Part of lane_probe.cpp.in, which names the namespace in PINOCCHIO_LANES.
#include "core/simd/lanes.h"
#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/texture.h"
#include "tests/core/trace/lane_probe.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

void samples(const shared::Sampling& sampling, const std::uint32_t* x, const std::uint32_t* y,
             std::uint32_t dimension, float* u, float* v, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const vec2 p = sample_2d(sampled_pixel(sampling, whole2(Int::load(x + i), Int::load(y + i))), dimension);
    p.x.store(u + i);
    p.y.store(v + i);
  }
}

void powers(const float* x, const float* y, float* result, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth)
    power(Float::load(x + i), Float::load(y + i)).store(result + i);
}

void store(const Vec& v, float* const* columns, std::size_t i) {
  v.x.store(columns[0] + i);
  v.y.store(columns[1] + i);
  v.z.store(columns[2] + i);
}

void environment_lights(const EnvironmentLight& environment, const float* const* direction,
                        float* const* light, float* density, std::size_t count) {
  const Mask all = Mask::from_bits(~0u);
  for (std::size_t i = 0; i < count; i += kWidth) {
    const Vec d(Float::load(direction[0] + i), Float::load(direction[1] + i), Float::load(direction[2] + i));
    store(light_from_environment(environment, d, all), light, i);
    density_of_light(environment, d, all).store(density + i);
  }
}

void environment_samples(const EnvironmentLight& environment, const float* u, const float* v,
                         float* const* direction, float* const* light, float* density, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const EnvironmentSample sample =
        sampled_environment(environment, {Float::load(u + i), Float::load(v + i)}, Mask::from_bits(~0u));
    store(sample.direction, direction, i);
    store(sample.light, light, i);
    sample.density.store(density + i);
  }
}

void angles(const float* revolutions, float* cosine, float* sine, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const Angle angle = angle_of(Float::load(revolutions + i));
    angle.cosine.store(cosine + i);
    angle.sine.store(sine + i);
  }
}

}  // namespace

const LaneProbe kProbe{Isa::PINOCCHIO_LANES, kWidth, samples, powers, sample_texture, environment_lights, environment_samples, angles};

}  // namespace pinocchio::PINOCCHIO_LANES
