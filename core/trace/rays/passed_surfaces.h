// The surfaces that shadow rays may pass, for the kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/trace/rays/material_marks.h"
#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

struct SceneArrays;  // trace/lanes/lane_steps.h

// `occluded` writes this for a ray that meets nothing but surfaces that a share of light passes.
inline constexpr std::uint8_t kMayPass = 2;

// Marks of materials. kHasHoles: alpha lets rays pass some points as if nothing were there. kPassesLight: a
// share of the light goes on where there is no hole.
inline constexpr std::uint8_t kHasHoles = 1, kPassesLight = 2;

struct PassedSurfaces {
  // Which lanes of a packet, the rays from `first` on, meet a hole of the triangle.
  using InHoles = unsigned (*)(const PassedSurfaces& passed, const RayColumns& rays, std::size_t first,
                               unsigned lanes, std::uint32_t triangle);

  MaterialMarks materials;
  InHoles in_holes;
  const SceneArrays* scene;
};

}  // namespace pinocchio
