// The sources that GLSL and C++ share, compiled here as C++ over GLM: one shading equation, two compilers.
#pragma once

#include <glm/glm.hpp>

#include "core/math/shared_material.h"

namespace pinocchio::shared {

#define SHARED [[nodiscard]] inline
#include "shaders/shared/view.glsl"
#include "shaders/shared/surface.glsl"
#include "shaders/shared/terminator.glsl"
#include "shaders/shared/sampling.glsl"
#include "shaders/shared/sized_light.glsl"
#undef SHARED

}  // namespace pinocchio::shared
