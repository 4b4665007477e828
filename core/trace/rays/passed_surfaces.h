// The surfaces that shadow rays may pass, for the kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/trace/rays/alpha_threshold.h"
#include "core/trace/rays/material_marks.h"
#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

struct SceneArrays;  // trace/lanes/lane_steps.h

// What `occluded` writes for a ray that meets nothing but surfaces that it may pass.
inline constexpr std::uint8_t kMayPass = 2;

struct PassedSurfaces {
  // Which lanes of a packet, the rays from `first` on, pass the triangle, as its alpha says.
  using InHoles = unsigned (*)(const PassedSurfaces& passed, const RayColumns& rays, std::size_t first,
                               unsigned lanes, std::uint32_t triangle);

  MaterialMarks materials;     // that have holes or transmit
  InHoles in_holes = nullptr;  // null: a ray that meets such a material may pass
  const SceneArrays* scene = nullptr;
  const std::uint32_t* pixel = nullptr;  // the rays'
  SamplePlace place{};
};

}  // namespace pinocchio
