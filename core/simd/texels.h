// Sums of RGBA texels of 8 bits, in the namespace of lanes that includes it.
#pragma once

#if defined(__SSE4_1__)
#include <immintrin.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
#endif

#include <cstddef>
#include <cstdint>

#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using TexelRow [[gnu::vector_size(16), gnu::may_alias]] = float;

inline std::uint32_t texel_bits(const void* from, std::uint32_t i) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, static_cast<const char*>(from) + 4 * std::size_t{i}, 4);
  return bits;
}

// Four texels: above left and right, below left and right; and their shares, whole numbers below 2^15.
struct TexelQuad {
  std::uint32_t bits[4];
  std::uint32_t left_right[2];  // above and below: the left one's share in the lower half
};

// What texels times their shares add up to, by channel, above and below: whole numbers' bits, of colours
// floats.
struct TexelSum {
  alignas(32) float above[4];
  float below[4];

  void clear() {
    auto* const to = reinterpret_cast<TexelRow*>(this);
    to[0] = to[1] = TexelRow{};
  }
};

#if defined(__SSE4_1__)

// Texels side by side, channel by channel.
inline __m128i left_right(std::uint32_t left, std::uint32_t right) {
  return _mm_unpacklo_epi8(_mm_cvtsi32_si128(as_int(left)), _mm_cvtsi32_si128(as_int(right)));
}

inline void add_texels(const TexelQuad& q, TexelSum& sum) {
  const __m128i above = left_right(q.bits[0], q.bits[1]), below = left_right(q.bits[2], q.bits[3]);
  const __m128i of_above = _mm_set1_epi32(as_int(q.left_right[0])),
                of_below = _mm_set1_epi32(as_int(q.left_right[1]));
#if defined(__AVX2__)
  auto* const to = reinterpret_cast<__m256i*>(&sum);
  const __m256i bytes = _mm256_cvtepu8_epi16(_mm_unpacklo_epi64(above, below));
  *to = _mm256_add_epi32(*to, _mm256_madd_epi16(bytes, _mm256_set_m128i(of_below, of_above)));
#else
  auto* const to = reinterpret_cast<__m128i*>(&sum);
  to[0] = _mm_add_epi32(to[0], _mm_madd_epi16(_mm_cvtepu8_epi16(above), of_above));
  to[1] = _mm_add_epi32(to[1], _mm_madd_epi16(_mm_cvtepu8_epi16(below), of_below));
#endif
}

#else

using TexelWords [[gnu::vector_size(16), gnu::may_alias]] = std::uint32_t;

inline void add_texels(const TexelQuad& q, TexelSum& sum) {
  auto* const to = reinterpret_cast<TexelWords*>(&sum);
  const auto bytes = [&](int k) {
    const std::uint32_t bits = q.bits[k];
    return TexelWords{bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24};
  };
  for (int row = 0; row < 2; ++row) {
    const std::uint32_t left = q.left_right[row] & 0xffffu, right = q.left_right[row] >> 16;
    to[row] = to[row] + (bytes(2 * row) * left + bytes(2 * row + 1) * right);
  }
}

#endif

// Without alpha. linear: of the 256 values of a channel.
inline void add_colors(const TexelQuad& q, const float* linear, TexelSum& sum) {
  const auto color = [&](int k) {
    const std::uint32_t bits = q.bits[k];
    return TexelRow{linear[bits & 255u], linear[bits >> 8 & 255u], linear[bits >> 16 & 255u], 0.0f};
  };
#if defined(__AVX2__)
  const __m256i shares =
      _mm256_set_m128i(_mm_set1_epi32(as_int(q.left_right[1])), _mm_set1_epi32(as_int(q.left_right[0])));
  const __m256 left = _mm256_cvtepi32_ps(_mm256_and_si256(shares, _mm256_set1_epi32(0xffff))),
               right = _mm256_cvtepi32_ps(_mm256_srli_epi32(shares, 16));
  auto* const to = reinterpret_cast<__m256*>(&sum);
  *to = *to + (_mm256_set_m128(__m128(color(2)), __m128(color(0))) * left +
               _mm256_set_m128(__m128(color(3)), __m128(color(1))) * right);
#else
  auto* const to = reinterpret_cast<TexelRow*>(&sum);
  for (int row = 0; row < 2; ++row) {
    const float left = as_float(q.left_right[row] & 0xffffu), right = as_float(q.left_right[row] >> 16);
    to[row] = to[row] + (color(2 * row) * left + color(2 * row + 1) * right);
  }
#endif
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
