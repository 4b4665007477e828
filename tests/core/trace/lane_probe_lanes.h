// Part of lane_probe.cpp.in, which names the namespace in PINOCCHIO_LANES.
#include "core/simd/lanes.h"
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

}  // namespace

const LaneProbe kProbe{samples, powers, sample_texture};

}  // namespace pinocchio::PINOCCHIO_LANES
