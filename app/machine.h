#pragma once

#include <memory>
#include <optional>

#include "app/options.h"
#include "gl/context.h"
#include "hybrid/prepared_scene.h"

namespace pinocchio::app {

// Everything that a verb draws with: the OpenGL context (none in raytrace mode), the worker threads, the
// plan and the scene made ready for it.
class Machine {
 public:
  // `keeps_mask`: the mask itself is wanted, not only the picture. `all_sides`: for any plan, not only the
  // options'. Ends the verb with kBadScene where no plan draws the scene; throws gl::NoContextError.
  Machine(const DrawOptions& options, Scene scene, bool keeps_mask, bool all_sides = false);

  [[nodiscard]] const PreparedScene& scene() const { return *scene_; }
  [[nodiscard]] const std::shared_ptr<const PreparedScene>& shared_scene() const { return scene_; }
  [[nodiscard]] const Needs& needs() const { return needs_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  // What the options ask of a plan on this machine.
  [[nodiscard]] PlanRequest request() const;
  [[nodiscard]] Workers& workers() { return *workers_; }
  [[nodiscard]] const gl::ContextInfo* gl_info() const { return context_ ? &context_->info() : nullptr; }
  // With PINOCCHIO_GL_DEBUG set, what the driver complains about is an error.
  void throw_gl_complaints() const {
    if (context_) context_->throw_complaints();
  }

 private:
  const DrawOptions& options_;
  bool keeps_mask_;
  Needs needs_;
  Plan plan_;
  std::unique_ptr<gl::Context> context_;  // outlives what was made in it
  std::optional<Workers> workers_;
  std::shared_ptr<const PreparedScene> scene_;
};

// The pixels to draw: --crop within --size, or all. Ends the verb with kUsage where they are none.
[[nodiscard]] PixelBox part_of(const DrawOptions& options);

}  // namespace pinocchio::app
