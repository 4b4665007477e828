// Part of trace/kernel.h's files: shaders/shared/sampling.glsl in lanes, to the last bit.
#pragma once

#include "core/trace/lanes/vector.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline Int mixed_bits(Int x) {
  x = x ^ shift_in_zeros<16>(x);
  x = x * Int(0x21f0aaadu);
  x = x ^ shift_in_zeros<15>(x);
  x = x * Int(0xd35a2d97u);
  return x ^ shift_in_zeros<15>(x);
}

template <int kBits>
inline Int swapped_groups(Int x, std::uint32_t low) {
  return (shift_in_zeros<kBits>(x) & Int(low)) | shift_left<kBits>(x & Int(low));
}
inline Int reversed_bits(Int x) {
  x = shift_in_zeros<16>(x) | shift_left<16>(x);
  x = swapped_groups<8>(x, 0x00ff00ffu);
  x = swapped_groups<4>(x, 0x0f0f0f0fu);
  x = swapped_groups<2>(x, 0x33333333u);
  return swapped_groups<1>(x, 0x55555555u);
}

inline Int owen_scrambled(Int reversed, Int seed) {
  Int x = reversed;
  x = x ^ (x * Int(0x3d20adeau));
  x = x + seed;
  x = x * (shift_in_zeros<16>(seed) | Int(1u));
  x = x ^ (x * Int(0x05526c56u));
  return x ^ (x * Int(0x53a22864u));
}

inline Int sobol_second(Int index) {
  index = index ^ shift_in_zeros<16>(index);
  index = index ^ (shift_in_zeros<8>(index) & Int(0x00ff00ffu));
  index = index ^ (shift_in_zeros<4>(index) & Int(0x0f0f0f0fu));
  index = index ^ (shift_in_zeros<2>(index) & Int(0x33333333u));
  return index ^ (shift_in_zeros<1>(index) & Int(0x55555555u));
}

struct IntPair {
  Int x, y;
};

inline IntPair scrambled_sobol(Int index, Int seed) {
  const Int shuffled = reversed_bits(owen_scrambled(reversed_bits(index), seed));
  return {reversed_bits(owen_scrambled(shuffled, mixed_bits(seed ^ Int(0x9e3779b9u)))),
          reversed_bits(owen_scrambled(sobol_second(shuffled), mixed_bits(seed ^ Int(0x7f4a7c15u))))};
}

inline IntPair dither_rotation(const IntPair& pixel, Int way) {
  const Mask even = (way & Int(1u)) == Int(0u), upright = (way & Int(2u)) == Int(0u);
  const Int x = select(even, pixel.x, pixel.y), straight = select(even, pixel.y, pixel.x);
  const Int y = select(upright, straight, straight ^ Int(0xffffffffu));
  const Int a(0xc13fa9a9u), b(0x91e10da5u);
  return {x * a + y * b, x * b - y * a};
}

// The pixels that the samples of a packet belong to, of the whole picture.
struct LaneSampling {
  const shared::Sampling& of;
  IntPair pixel;
  Int pixel_seed;

  LaneSampling(const shared::Sampling& s, const IntPair& p)
      : of(s), pixel(p), pixel_seed(mixed_bits(p.x + mixed_bits(p.y + mixed_bits(Int(s.seed))))) {}
};

struct LanePoint {
  Float x, y;
};

inline LanePoint sample_2d(const LaneSampling& s, std::uint32_t dimension) {
  const Int of_dimension(dimension * 0x9e3779b9u);
  IntPair bits;
  if (s.of.sequence == shared::kSequenceBlueNoise) {
    const Int all = mixed_bits(mixed_bits(Int(s.of.seed)) + of_dimension);
    const IntPair point = scrambled_sobol(Int(s.of.index), all), turned = dither_rotation(s.pixel, all);
    bits = {point.x + turned.x, point.y + turned.y};
  } else {
    const Int own = mixed_bits(s.pixel_seed + of_dimension);
    if (s.of.sequence == shared::kSequenceSobol) {
      bits = scrambled_sobol(Int(s.of.index), own);
    } else {
      const Int x = mixed_bits(own + Int(s.of.index * 0x9e3779b9u));
      bits = {x, mixed_bits(x + Int(0x7f4a7c15u))};
    }
  }
  const Float step(1.0f / 16777216.0f);
  return {to_float(shift_in_zeros<8>(bits.x)) * step, to_float(shift_in_zeros<8>(bits.y)) * step};
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
