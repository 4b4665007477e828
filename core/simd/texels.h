// Sums of RGBA texels of 8 bits, in the namespace of lanes that includes it.
#pragma once

#if defined(__SSE4_1__)
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstdint>

#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using TexelRow [[gnu::vector_size(16), gnu::may_alias]] = float;

inline std::uint32_t texel_bits(const char* at) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, at, sizeof(bits));
  return bits;
}

// The addresses of the four texels about a point: above left, above right, below left, below right.
struct TexelQuad {
  const char* at[4];
};

// The shares of these texels, whole numbers below 2^15. `above` and `below` hold two each: the left texel's
// in the lower 16 bits, the right one's in the upper.
struct TexelShares {
#if defined(__AVX2__)
  __m256i pairs;
  TexelShares(std::uint32_t above, std::uint32_t below)
      : pairs(_mm256_blend_epi32(_mm256_set1_epi32(as_int(above)), _mm256_set1_epi32(as_int(below)), 0xf0)) {}
#else
  std::uint32_t rows[2];
  TexelShares(std::uint32_t above, std::uint32_t below) : rows{above, below} {}
#endif
};

// The sum of texels times their shares, for each channel; texels above and below their points are summed
// apart. add_texels() keeps whole numbers in these bits, add_colors() floats.
struct TexelSum {
  alignas(32) float above[4];
  float below[4];

  void clear() {
    auto* const to = reinterpret_cast<TexelRow*>(this);
    to[0] = to[1] = TexelRow{};
  }
};

#if defined(__SSE4_1__)

// The bytes of two texels in turn: red left, red right, green left and so on.
inline __m128i left_right(const char* left, const char* right) {
  return _mm_unpacklo_epi8(_mm_cvtsi32_si128(as_int(texel_bits(left))),
                           _mm_cvtsi32_si128(as_int(texel_bits(right))));
}

inline void add_texels(const TexelQuad& q, const TexelShares& shares, TexelSum& sum) {
  const __m128i above = left_right(q.at[0], q.at[1]), below = left_right(q.at[2], q.at[3]);
#if defined(__AVX2__)
  auto* const to = reinterpret_cast<__m256i*>(&sum);
  const __m256i bytes = _mm256_cvtepu8_epi16(_mm_unpacklo_epi64(above, below));
  *to = _mm256_add_epi32(*to, _mm256_madd_epi16(bytes, shares.pairs));
#else
  auto* const to = reinterpret_cast<__m128i*>(&sum);
  const auto times = [&](__m128i bytes, int row) {
    return _mm_madd_epi16(_mm_cvtepu8_epi16(bytes), _mm_set1_epi32(as_int(shares.rows[row])));
  };
  to[0] = _mm_add_epi32(to[0], times(above, 0));
  to[1] = _mm_add_epi32(to[1], times(below, 1));
#endif
}

#else

using TexelWords [[gnu::vector_size(16), gnu::may_alias]] = std::uint32_t;

inline void add_texels(const TexelQuad& q, const TexelShares& shares, TexelSum& sum) {
  auto* const to = reinterpret_cast<TexelWords*>(&sum);
  const auto bytes = [&](int k) {
    const std::uint32_t bits = texel_bits(q.at[k]);
    return TexelWords{bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24};
  };
  for (int row = 0; row < 2; ++row)
    to[row] = to[row] +
              (bytes(2 * row) * (shares.rows[row] & 0xffffu) + bytes(2 * row + 1) * (shares.rows[row] >> 16));
}

#endif

// Without alpha. linear: of the 256 values of a channel.
inline void add_colors(const TexelQuad& q, const TexelShares& shares, const float* linear, TexelSum& sum) {
  const auto color = [&](int k) {
    const std::uint32_t bits = texel_bits(q.at[k]);
    return TexelRow{linear[bits & 255u], linear[bits >> 8 & 255u], linear[bits >> 16 & 255u], 0.0f};
  };
#if defined(__AVX2__)
  const __m256 left = _mm256_cvtepi32_ps(_mm256_and_si256(shares.pairs, _mm256_set1_epi32(0xffff))),
               right = _mm256_cvtepi32_ps(_mm256_srli_epi32(shares.pairs, 16));
  auto* const to = reinterpret_cast<__m256*>(&sum);
  *to = *to + (_mm256_set_m128(__m128(color(2)), __m128(color(0))) * left +
               _mm256_set_m128(__m128(color(3)), __m128(color(1))) * right);
#else
  auto* const to = reinterpret_cast<TexelRow*>(&sum);
  for (int row = 0; row < 2; ++row)
    to[row] = to[row] + (color(2 * row) * as_float(shares.rows[row] & 0xffffu) +
                         color(2 * row + 1) * as_float(shares.rows[row] >> 16));
#endif
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
