// The rest of what GLSL and C++ share, for those who look textures up.
#pragma once

#include "core/image/tonemap.h"
#include "core/trace/shared.h"
#include "pinocchio/texture.h"

namespace pinocchio::shared {

struct TexelSource {
  const glm::u8vec4 *first_level, *others;
  int first_count;
};

[[nodiscard]] inline vec4 texel_at(const TexelSource& source, int i, bool is_color) {
  const glm::u8vec4& t =
      i < source.first_count ? source.first_level[i] : source.others[i - source.first_count];
  const vec4 raw(static_cast<float>(t.r), static_cast<float>(t.g), static_cast<float>(t.b),
                 static_cast<float>(t.a));
  if (!is_color) return raw / 255.0f;
  return {srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b), raw.a / 255.0f};
}

// By force: a tap is a few instructions, and GLSL hands structs over by value.
#define SHARED [[nodiscard, gnu::always_inline]] inline
#include "shaders/shared/texture.glsl"
#undef SHARED
#define SHARED [[nodiscard]] inline
#include "shaders/shared/maps.glsl"
#undef SHARED

}  // namespace pinocchio::shared
