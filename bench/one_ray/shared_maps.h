// The sources that GLSL and C++ share of textures and maps, compiled here as C++, a point at a time.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/image/tonemap.h"
#include "core/math/log2_series.h"
#include "core/shade/shared.h"
#include "pinocchio/conversion.h"
#include "pinocchio/material_maps.h"
#include "pinocchio/texture.h"

namespace pinocchio::shared {

// Texture look-ups. A colour's four channels are one register.
namespace texels {

using Channels __attribute__((vector_size(16))) = float;

struct vec4 {
  Channels lanes;
  explicit vec4(float all) : lanes{all, all, all, all} {}
  explicit vec4(Channels c) : lanes(c) {}
  friend vec4 operator+(const vec4& a, const vec4& b) { return vec4(a.lanes + b.lanes); }
  friend vec4 operator*(const vec4& a, float b) { return vec4(a.lanes * b); }
  friend vec4 operator/(const vec4& a, float b) { return vec4(a.lanes / b); }
  explicit operator glm::vec4() const { return {lanes[0], lanes[1], lanes[2], lanes[3]}; }
};

struct TexelSource {
  const TexelBlocks* blocks;
  const float* linear_from_srgb8;
};

[[nodiscard, gnu::always_inline]] inline ivec3 level_at(const TexelSource& source, ivec2, int level) {
  const ivec2 size = source.blocks->size(level);
  return {as_int(source.blocks->first(level)), size.x, size.y};
}

[[nodiscard, gnu::always_inline]] inline int texel_place(int width, int x, int y) {
  return as_int(TexelBlocks::place(width, x, y));
}

[[nodiscard, gnu::always_inline]] inline vec4 texel_at(const TexelSource& source, int i, bool is_color) {
  const glm::u8vec4& t = source.blocks->data()[i];
  if (!is_color) return vec4(Channels{as_float(t.r), as_float(t.g), as_float(t.b), as_float(t.a)});
  const float* const linear = source.linear_from_srgb8;
  return vec4(Channels{linear[t.r], linear[t.g], linear[t.b], 0.0f});
}
[[nodiscard]] constexpr float texel_scale(bool is_color) {
  return is_color ? 1.0f : 255.0f;
}

// As the lanes find it.
[[nodiscard]] inline float level_of(float texels) {
  const auto bits = std::bit_cast<std::uint32_t>(texels);
  const int exponent = static_cast<int>(bits - 0x3f3504f3u) >> 23;
  return as_float(exponent) +
         log2_series(std::bit_cast<float>(bits - (static_cast<std::uint32_t>(exponent) << 23)));
}

// Always inlined: a tap is a few instructions, and GLSL passes structs by value.
#define SHARED [[nodiscard, gnu::always_inline]] inline
#include "shaders/shared/texture.glsl"
#undef SHARED

}  // namespace texels

// The texels of a material's maps at a point, in the order of kMapUses. A map that is not used is white.
struct MapTexels {
  glm::vec4 of[kMapUses.size()];
};
[[nodiscard]] inline const glm::vec4& texel_of(const MapTexels& texels, int use, bool) {
  return texels.of[use];
}

#define SHARED [[nodiscard]] inline
#define READ_ONLY(type) const type&
#include "shaders/shared/maps.glsl"
#undef READ_ONLY
#undef SHARED

}  // namespace pinocchio::shared
