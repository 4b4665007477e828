#pragma once

#include <optional>

#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "hybrid/gpu_scene.h"
#include "hybrid/plan.h"

namespace pinocchio {

// The scene with what the plan's passes need of it: the CPU's tree, the GPU's buffers. It stays where it
// is, as the tree's users point into it.
struct PreparedScene {
  Scene scene;
  std::optional<Tracer> tracer;
  std::optional<GpuScene> gpu;

  PreparedScene(Scene s, const Plan& plan, const BuildOptions& tree, std::optional<Isa> isa)
      : scene(std::move(s)) {
    if (plan.traces() || plan.mode == Mode::raytrace) tracer.emplace(scene, tree, isa);
    if (plan.mode != Mode::raytrace) gpu.emplace(scene);
  }
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;
};

}  // namespace pinocchio
