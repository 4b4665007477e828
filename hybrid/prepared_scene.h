#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/scene/scene.h"
#include "core/trace/lit_cells.h"
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

// The scene with what the sides need of it: the CPU's tree, the GPU's buffers.
struct PreparedScene {
  Scene scene;
  std::shared_ptr<const Tracer> tracer;  // null: nothing traces (yet)
  std::optional<GpuScene> gpu;

  PreparedScene(Scene s, Sides sides, const BuildOptions& tree, std::optional<Isa> isa,
                OffsetMethod offset = OffsetMethod::error_bound)
      : scene(std::move(s)) {
    drop_idle_casters(scene);
    if (sides.cpu) tracer = std::make_shared<const Tracer>(scene.mesh, tree, isa, offset);
    if (sides.gpu) gpu.emplace(scene);
  }
  // The same mesh under other lights; tree and GPU buffers are shared, too.
  PreparedScene(const std::shared_ptr<const PreparedScene>& of, std::vector<Light> lights)
      : scene(of->scene), tracer(of->tracer), gpu(of->gpu) {
    relight(std::move(lights));
  }
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  // Changes the lights in place; no frame in flight may be using it.
  void relight(std::vector<Light> lights) {
    scene.lights = std::move(lights);
    drop_idle_casters(scene);
    if (gpu) gpu->relight(scene);
  }

  [[nodiscard]] const Tracer& required_tracer() const {
    if (!tracer) throw std::logic_error("a plan that traces was given a scene without a tree");
    return *tracer;
  }

  // What shadow passes of this scene have learned, for the next one: of any thread. Null for the first pass
  // (a single picture learns nothing that it could use) and where rays are not exact enough to be spared.
  [[nodiscard]] LitCells* lit_cells() const;

 private:
  mutable std::mutex cells_mutex_;
  mutable std::shared_ptr<const Tracer> cells_tracer_;  // that they were made for
  mutable std::unique_ptr<LitCells> cells_;
};

}  // namespace pinocchio
