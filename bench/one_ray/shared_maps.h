// The sources that GLSL and C++ share of textures and maps, compiled here as C++, a point at a time.
#pragma once

#include <array>

#include "core/image/tonemap.h"
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
  vec4& operator+=(const vec4& other) { return lanes += other.lanes, *this; }
  friend vec4 operator/(const vec4& a, float b) { return vec4(a.lanes / b); }
  explicit operator glm::vec4() const { return {lanes[0], lanes[1], lanes[2], lanes[3]}; }
};
[[nodiscard]] inline vec4 mix(const vec4& a, const vec4& b, float share) {
  return vec4(a.lanes * (1.0f - share) + b.lanes * share);
}

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
  const auto a = as_float(t.a);
  if (!is_color) return vec4(Channels{as_float(t.r), as_float(t.g), as_float(t.b), a} / 255.0f);
  const float* const linear = source.linear_from_srgb8;
  return vec4(Channels{linear[t.r], linear[t.g], linear[t.b], a / 255.0f});
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
