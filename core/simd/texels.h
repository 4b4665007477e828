// RGBA texels of 8 bits as rows of floats, from 0 to 1, in the namespace of lanes that includes it:
// one, or those of two levels of a texture side by side.
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

inline TexelRow load_row(const float* p) {
  return *reinterpret_cast<const TexelRow*>(p);
}
inline void store_row(float* p, TexelRow row) {
  *reinterpret_cast<TexelRow*>(p) = row;
}

inline std::uint32_t texel_bits(const void* from, std::uint32_t i) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, static_cast<const char*>(from) + 4 * std::size_t{i}, 4);
  return bits;
}

// c / 255 for c from 0 to 255, the same bits without a division: the first product is exact.
inline constexpr float kBy255 = 0x1.01p-8f, kBy255Rest = 0x1.010102p-24f;
constexpr bool is_exact() {
  for (int c = 0; c < 256; ++c) {
    const auto x = as_float(c);
    if (x * kBy255 + x * kBy255Rest != x / 255.0f) return false;
  }
  return true;
}
static_assert(is_exact());

inline TexelRow bytes_of(std::uint32_t bits) {
#if defined(__SSE4_1__)
  return TexelRow(_mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(as_int(bits)))));
#elif defined(__ARM_NEON)
  const uint8x8_t bytes = vreinterpret_u8_u32(vdup_n_u32(bits));
  return TexelRow(vcvtq_f32_u32(vmovl_u16(vget_low_u16(vmovl_u8(bytes)))));
#else
  return TexelRow{as_float(bits & 255u), as_float(bits >> 8 & 255u), as_float(bits >> 16 & 255u),
                  as_float(bits >> 24)};
#endif
}

inline TexelRow texel_row(std::uint32_t bits) {
  const TexelRow bytes = bytes_of(bits);
  return bytes * kBy255 + bytes * kBy255Rest;
}

// Without alpha.
inline TexelRow color_row(std::uint32_t bits, const float* linear) {
  return TexelRow{linear[bits & 255u], linear[bits >> 8 & 255u], linear[bits >> 16 & 255u], 0.0f};
}

inline TexelRow mixed(TexelRow a, TexelRow b, float share) {
  return a * (1.0f - share) + b * share;
}

#if defined(__AVX2__)

// Shares of two rows.
struct TexelWeights {
  __m256 second, first;
  void set(float a, float b) {
    second = _mm256_set_m128(_mm_set1_ps(b), _mm_set1_ps(a));
    first = _mm256_set1_ps(1.0f) - second;
  }
};

struct TexelRows {
  __m256 v;
  [[nodiscard]] TexelRow first() const { return TexelRow(_mm256_castps256_ps128(v)); }
  [[nodiscard]] TexelRow second() const { return TexelRow(_mm256_extractf128_ps(v, 1)); }
};
inline TexelRows texel_rows(std::uint32_t a, std::uint32_t b) {
  const __m128i bits = _mm_cvtsi64_si128(static_cast<long long>(a | std::uint64_t{b} << 32));
  const __m256 bytes = _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(bits));
  return {bytes * _mm256_set1_ps(kBy255) + bytes * _mm256_set1_ps(kBy255Rest)};
}
inline TexelRows color_rows(std::uint32_t a, std::uint32_t b, const float* linear) {
  return {_mm256_set_m128(__m128(color_row(b, linear)), __m128(color_row(a, linear)))};
}
inline TexelRows mixed(const TexelRows& a, const TexelRows& b, const TexelWeights& share) {
  return {a.v * share.first + b.v * share.second};
}

#else

struct TexelWeights {
  float fine, coarse;
  void set(float a, float b) {
    fine = a;
    coarse = b;
  }
};

struct TexelRows {
  TexelRow a, b;
  [[nodiscard]] TexelRow first() const { return a; }
  [[nodiscard]] TexelRow second() const { return b; }
};
inline TexelRows texel_rows(std::uint32_t a, std::uint32_t b) {
  return {texel_row(a), texel_row(b)};
}
inline TexelRows color_rows(std::uint32_t a, std::uint32_t b, const float* linear) {
  return {color_row(a, linear), color_row(b, linear)};
}
inline TexelRows mixed(const TexelRows& p, const TexelRows& q, const TexelWeights& share) {
  return {mixed(p.a, q.a, share.fine), mixed(p.b, q.b, share.coarse)};
}

#endif

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
