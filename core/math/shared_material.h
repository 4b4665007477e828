// The sources that GLSL and C++ share of materials, compiled here as C++ over GLM: one shading equation, two
// compilers.
#pragma once

#include <glm/glm.hpp>

namespace pinocchio::shared {

using namespace glm;  // GLSL's names: vec3, dot, cross, clamp, ...

#define SHARED [[nodiscard]] inline
// In the order in which they need each other:
// clang-format off
#include "shaders/shared/phong.glsl"
#include "shaders/shared/metallic_roughness.glsl"
// clang-format on
#undef SHARED

}  // namespace pinocchio::shared
