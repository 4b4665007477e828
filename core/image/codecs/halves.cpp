#include "core/image/codecs/halves.h"

#include <algorithm>
#include <cstddef>

namespace pinocchio {
namespace {

constexpr std::size_t kFour = 4;
using FourFloats [[gnu::vector_size(4 * kFour)]] = float;
using FourWords [[gnu::vector_size(4 * kFour)]] = std::int32_t;
using FourHalves [[gnu::vector_size(2 * kFour)]] = std::uint16_t;

constexpr std::int32_t kInfinite = 0x7f800000, kLargestHalf = 0x477fe000, kLeastNormalHalf = 0x38800000;

// Without branches: those of neighbours in a picture differ.
FourHalves half_bits(FourFloats values) {
  const auto bits = __builtin_bit_cast(FourWords, values);
  const FourWords size = bits & 0x7fffffff;
  const FourWords finite = size < kLargestHalf ? size : FourWords{} + kLargestHalf;
  const FourWords normal = (finite - 0x38000000 + 0xfff + (finite >> 13 & 1)) >> 13;
  // The last bit of 0.5 is worth that of subnormal halves, so that the sum is rounded there.
  const FourWords subnormal =
      __builtin_bit_cast(FourWords, __builtin_bit_cast(FourFloats, finite) + 0.5f) - 0x3f000000;
  const FourWords nan = (size & 0x007fffff) >> 13;
  const FourWords not_finite =
      0x7c00 | nan | (((size > kInfinite) & (nan == 0)) ? FourWords{} + 1 : FourWords{});
  const FourWords half = size >= kInfinite ? not_finite : (size < kLeastNormalHalf ? subnormal : normal);
  return __builtin_convertvector((bits >> 16 & 0x8000) | half, FourHalves);
}

}  // namespace

void to_halves(std::span<const float> values, std::uint16_t* to) {
  const auto convert = [&](std::size_t first, std::size_t count) {
    FourFloats four{};
    __builtin_memcpy(&four, values.data() + first, count * sizeof(float));
    const FourHalves halves = half_bits(four);
    __builtin_memcpy(to + first, &halves, count * sizeof(std::uint16_t));
  };
  std::size_t i = 0;
  for (; i + kFour <= values.size(); i += kFour) convert(i, kFour);
  if (i < values.size()) convert(i, values.size() - i);
}

}  // namespace pinocchio
