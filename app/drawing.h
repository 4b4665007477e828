#pragma once

#include <memory>
#include <optional>

#include "app/animation.h"
#include "app/options.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/pose_ahead.h"

namespace pinocchio::app {

// What a verb draws with: the Engine, the scene, and the settings resolved for it.
class Drawing {
 public:
  // `usual`: the exchange where the options name none. `keeps_mask`: the mask itself is wanted, not only the
  // picture. `any_settings`: others than the options' are going to be drawn, too. `only`: of all frames, if
  // there is one. Ends the verb with kBadScene (kUsage, where a plan's file says them) where the settings
  // cannot draw the scene; throws NoOpenGlError.
  Drawing(const DrawOptions& options, Scene scene, Exchange usual, bool keeps_mask, bool any_settings = false,
          const std::optional<Camera>& only = {});

  [[nodiscard]] Engine& engine() { return engine_; }
  // As it was loaded.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const SceneStats& stats() const { return stats_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] Workers& workers() const { return engine_.workers(settings_.threads); }
  // Of the context that the settings draw in; null where the CPU draws alone.
  [[nodiscard]] const gl::ContextInfo* gl_info() const {
    return settings_.uses_gpu() ? engine_.gl_info() : nullptr;
  }

  // Other settings for the same scene.
  [[nodiscard]] Expected<Settings> resolve(const Settings& wanted) const;
  // A frame, its scene as it is then; `next`: the one that follows, whose scene is made meanwhile. Ends the
  // verb with kBadScene where the scene cannot be posed.
  [[nodiscard]] FrameRequest request(const Settings& settings, const CameraFrame& frame,
                                     const CameraFrame* next = nullptr);
  // The same by the run's own settings, without what rays are traced in.
  [[nodiscard]] FrameRequest untraced_request(const CameraFrame& frame) const;

 private:
  // Says where --mode auto would be faster than these settings.
  void advise(Settings automatic) const;

  const DrawOptions& options_;
  PixelBox part_;
  bool keeps_mask_;
  bool software_gl_ = false;
  Engine engine_;
  Scene scene_;
  SceneStats stats_;
  Settings settings_;
  std::shared_ptr<const Tracer> tracer_;  // of a scene that stands still
  std::optional<PoseAhead> poses_;        // of one that is animated
};

}  // namespace pinocchio::app
