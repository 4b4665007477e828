#pragma once

#include <memory>
#include <optional>

#include "app/cli/options.h"
#include "app/run/animation.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/pose_ahead.h"

namespace pinocchio::app {

inline constexpr const char* kDrawnByRaysAlone = "a panorama, a fisheye or a distorted lens";
// Ends the verb with kUsage for a camera that OpenGL cannot draw. `what` needs OpenGL.
void require_rasterisable(const Camera& camera, const std::string& what);

// The Engine, the scene and the resolved settings of a verb that draws.
class Drawing {
 public:
  // `usual`: the exchange where the options name none. `keeps_mask`: the mask itself is needed, not only the
  // picture. `any_settings`: other settings are drawn, too. `only`: the camera of all frames, if there is
  // one. Ends the verb with kBadScene (kUsage for a plan's file) where the settings cannot draw the scene;
  // throws NoOpenGlError.
  Drawing(const DrawOptions& options, Scene scene, Exchange usual, bool keeps_mask, bool any_settings = false,
          const std::optional<Camera>& only = {});

  [[nodiscard]] Engine& engine() { return engine_; }
  // As it was loaded.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const SceneStats& stats() const { return stats_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] Workers& workers() const { return engine_.workers(settings_.threads); }
  // The context that draws. Null: the CPU draws alone.
  [[nodiscard]] const gl::ContextInfo* gl_info() const {
    return settings_.uses_gpu() ? engine_.gl_info() : nullptr;
  }

  // Resolves other settings for the same scene.
  [[nodiscard]] Expected<Settings> resolve(const Settings& wanted) const;
  // A frame, with the scene at its time. `next`: the following frame, whose scene is posed in the background.
  // Ends the verb with kBadScene where the scene cannot be posed.
  [[nodiscard]] FrameRequest request(const Settings& settings, const CameraFrame& frame,
                                     const CameraFrame* next = nullptr);
  // The same by the run's own settings, without a tracer.
  [[nodiscard]] FrameRequest untraced_request(const CameraFrame& frame) const;

 private:
  // Prints a hint where --mode auto would be faster.
  void advise(Settings automatic) const;

  const DrawOptions& options_;
  PixelBox part_;
  bool keeps_mask_;
  bool software_gl_ = false;
  bool needs_rays_ = false;  // the camera's: OpenGL cannot draw them
  Engine engine_;
  Scene scene_;
  SceneStats stats_;
  Settings settings_;
  std::shared_ptr<const Tracer> tracer_;  // of a scene without animation
  std::optional<PoseAhead> poses_;        // of an animated scene
};

}  // namespace pinocchio::app
