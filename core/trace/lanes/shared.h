// Part of walk/kernel.h's files: the sources that GLSL and C++ share, compiled over lanes. What is the same
// for all points of a packet (a light, the sampling) stays scalar, so that branches on it are branches.
#pragma once

#include "core/shade/gltf_surface.h"
#include "core/shade/shared.h"
#include "core/trace/lanes/power.h"
#include "core/trace/lanes/vector.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// What the sources are written over (shaders/shared/glsl.glsl).
using real = Float;
using boolean = Mask;
using vec3 = Vec;

inline Mask operator>(Float a, Float b) {
  return b < a;
}
inline Mask operator!=(Float a, Float b) {
  return ~(a == b);
}
inline Mask operator&&(Mask a, Mask b) {
  return a & b;
}
inline Mask operator||(Mask a, Mask b) {
  return a | b;
}
inline Mask operator!(Mask a) {
  return ~a;
}
inline bool any(Mask m) {
  return m.bits() != 0;
}
inline Mask none() {
  return Mask::from_bits(0);
}
inline Float pick(Mask m, Float yes, Float no) {
  return select(m, yes, no);
}
inline Vec pick(Mask m, const Vec& yes, const Vec& no) {
  return select(m, yes, no);
}
inline Float pow(Float x, Float y) {
  return power(x, y);
}
inline Float mix(Float a, Float b, Float share) {
  return a * (Float(1.0f) - share) + b * share;
}
inline Vec mix(const Vec& a, const Vec& b, Float share) {
  return a * (Float(1.0f) - share) + b * share;
}
inline Vec min(const Vec& a, const Vec& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
inline Float& operator*=(Float& a, Float b) {
  return a = a * b;
}
inline Float length(const Vec& v) {
  return sqrt(dot(v, v));
}

struct vec2 {
  Float x, y;
  vec2() = default;
  explicit vec2(Float all) : x(all), y(all) {}
  vec2(Float a, Float b) : x(a), y(b) {}
};
inline vec2 operator-(const vec2& a, float b) {
  return {a.x - b, a.y - b};
}
inline vec2 operator*(const vec2& a, float b) {
  return {a.x * b, a.y * b};
}
inline vec2 operator*(float a, const vec2& b) {
  return b * a;
}
inline vec2 operator*(Float a, const vec2& b) {
  return {a * b.x, a * b.y};
}
inline vec2 operator+(const vec2& a, const vec2& b) {
  return {a.x + b.x, a.y + b.y};
}
inline vec2 operator-(const vec2& a, const vec2& b) {
  return {a.x - b.x, a.y - b.y};
}

struct vec4 {
  Float x, y, z, w;
  vec4() = default;
  vec4(Float a, Float b, Float c, Float d) : x(a), y(b), z(c), w(d) {}
  explicit vec4(Float all) : x(all), y(all), z(all), w(all) {}
  explicit vec4(const glm::vec4& all) : x(all.x), y(all.y), z(all.z), w(all.w) {}
  explicit operator Vec() const { return {x, y, z}; }
};

// The texels of a material's maps at the points, in the order of kMapUses. A map that is not used is white.
struct MapTexels {
  vec4 of[kMapUses.size()];
};
inline const vec4& texel_of(const MapTexels& texels, int use, bool) {
  return texels.of[use];
}

// Bits without a sign.
struct whole {
  Int v;
  whole() = default;
  whole(Int bits) : v(bits) {}            // NOLINT: the same bits
  whole(std::uint32_t bits) : v(bits) {}  // NOLINT: all lanes

  friend whole operator>>(whole a, unsigned n) { return Int::of(a.v.v >> n); }
  friend whole operator<<(whole a, unsigned n) { return Int::of(a.v.v << n); }
  friend whole operator~(whole a) { return a ^ 0xffffffffu; }
  friend whole operator+(whole a, whole b) { return a.v + b.v; }
  friend whole operator-(whole a, whole b) { return a.v - b.v; }
  friend whole operator*(whole a, whole b) { return a.v * b.v; }
  friend whole operator&(whole a, whole b) { return a.v & b.v; }
  friend whole operator|(whole a, whole b) { return a.v | b.v; }
  friend whole operator^(whole a, whole b) { return a.v ^ b.v; }
  friend Mask operator!=(whole a, whole b) { return ~(a.v == b.v); }
  whole& operator+=(whole b) { return *this = *this + b; }
  whole& operator*=(whole b) { return *this = *this * b; }
  whole& operator^=(whole b) { return *this = *this ^ b; }
};

struct whole2 {
  whole x, y;
  whole2() = default;
  whole2(whole a, whole b) : x(a), y(b) {}
  explicit operator vec2() const { return {to_float(x.v), to_float(y.v)}; }  // below 2^31
};
inline whole2 operator+(const whole2& a, const whole2& b) {
  return {a.x + b.x, a.y + b.y};
}
inline whole2 operator>>(const whole2& a, unsigned n) {
  return {a.x >> n, a.y >> n};
}
inline whole2 pick(Mask m, const whole2& yes, const whole2& no) {
  return {select(m, yes.x.v, no.x.v), select(m, yes.y.v, no.y.v)};
}

using uint = std::uint32_t;
using LightParams = const shared::LightParams&;
using Sampling = shared::Sampling;
using shared::kLightDirectional, shared::kLightRectangle, shared::kLightSpot;
using shared::kSequenceBlueNoise, shared::kSequenceRandom, shared::kSequenceZOrder;

using ivec2 = glm::ivec2;

struct EnvironmentTexels {
  const glm::vec3* pixels;
  std::uint32_t width;
  Mask lanes;  // others read nothing
};

inline Vec environment_texel(const EnvironmentTexels& texels, Float column, Float row) {
  const Int first = (to_int(row) * Int(texels.width) + to_int(column)) * Int(3);
  const auto channel = [&](std::uint32_t c) {
    return from_bits(gather(texels.pixels, first + Int(c), texels.lanes));
  };
  return {channel(0), channel(1), channel(2)};
}

struct SkyIrradiance {
  const glm::vec3* c;
};

// As GLM has them: the first operand where either is NaN.
#define min(a, b) min(b, a)
#define max(a, b) max(b, a)
#define SHARED [[nodiscard, maybe_unused, gnu::always_inline]] inline
#define READ_ONLY(type) const type&
// clang-format off
#include "shaders/shared/layers.glsl"
#include "shaders/shared/phong.glsl"
#include "shaders/shared/microfacet.glsl"
#include "shaders/shared/metallic_roughness.glsl"
#include "shaders/shared/maps.glsl"
#include "shaders/shared/sampling.glsl"
#include "shaders/shared/sized_light.glsl"
#include "shaders/shared/surface.glsl"
#include "shaders/shared/terminator.glsl"
#include "shaders/shared/environment.glsl"
#include "shaders/shared/prefiltered.glsl"
// clang-format on
#undef READ_ONLY
#undef SHARED
#undef min
#undef max

inline Layers layers_of(const GltfLayers& layers) {
  const LayerTexels texels = layer_texels(layers);
  return layers_of(vec4(texels.first), vec4(texels.second));
}
inline const Layers& layers_of(const Layers& layers) {
  return layers;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
