// The sources that GLSL and C++ share, compiled here as C++ over GLM, a point at a time.
// core/trace/lanes/shared.h compiles them over lanes.
#pragma once

#include <glm/glm.hpp>

#include "core/shade/shared_material.h"

namespace pinocchio::shared {

#define SHARED [[nodiscard]] inline
// In the order in which they need each other:
// clang-format off
#include "shaders/shared/view.glsl"
#include "shaders/shared/surface.glsl"
#include "shaders/shared/terminator.glsl"
#include "shaders/shared/sampling_params.glsl"
#include "shaders/shared/texture_params.glsl"
#include "shaders/shared/sampling.glsl"
#include "shaders/shared/sized_light.glsl"
// clang-format on
#undef SHARED

}  // namespace pinocchio::shared
