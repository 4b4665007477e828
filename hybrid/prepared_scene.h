#pragma once

#include <optional>

#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "hybrid/gpu_scene.h"
#include "hybrid/plan.h"

namespace pinocchio {

// Which of the two a plan's passes run on.
struct Sides {
  bool cpu = true, gpu = true;
};
[[nodiscard]] inline Sides sides_of(const Plan& plan) {
  if (plan.mode == Mode::raytrace) return {!plan.precise, false};  // the reference has a tree of its own
  return {plan.traces(), true};
}

// The scene with what the sides need of it: the CPU's tree, the GPU's buffers. It stays where it is, as
// the tree's users point into it.
struct PreparedScene {
  Scene scene;
  std::optional<Tracer> tracer;
  std::optional<GpuScene> gpu;

  PreparedScene(Scene s, Sides sides, const BuildOptions& tree, std::optional<Isa> isa,
                OffsetMethod offset = OffsetMethod::error_bound)
      : scene(std::move(s)) {
    drop_idle_casters(scene);
    if (sides.cpu) tracer.emplace(scene, tree, isa, offset);
    if (sides.gpu) gpu.emplace(scene);
  }
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;
};

}  // namespace pinocchio
