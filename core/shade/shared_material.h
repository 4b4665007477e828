// The sources that GLSL and C++ share of materials and lights, compiled here as C++ over GLM, a point at a
// time.
#pragma once

#include <glm/glm.hpp>

namespace pinocchio::shared {

using namespace glm;  // GLSL's names: vec3, dot, cross, clamp, ...

// What the sources are written over (shaders/shared/glsl.glsl).
using real = float;
using boolean = bool;
using whole = uint;
using whole2 = uvec2;
template <class T>
[[nodiscard]] T pick(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}
[[nodiscard]] inline bool any(bool condition) {
  return condition;
}
[[nodiscard]] inline bool none() {
  return false;
}

#define SHARED [[nodiscard]] inline
#define READ_ONLY(type) const type&
// In the order in which they need each other:
// clang-format off
#include "shaders/shared/light_params.glsl"
#include "shaders/shared/layers.glsl"
#include "shaders/shared/phong.glsl"
#include "shaders/shared/microfacet.glsl"
#include "shaders/shared/metallic_roughness.glsl"
// clang-format on
#undef READ_ONLY
#undef SHARED

}  // namespace pinocchio::shared
