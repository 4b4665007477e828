// Animated scenes: each pose with its tree is made on a thread of its own, while frames of the one before are
// drawn.
#include <chrono>
#include <cmath>
#include <utility>

#include "app/animation.h"
#include "app/console.h"
#include "app/window/session.h"
#include "core/parallel/start_thread.h"
#include "pinocchio/animation.h"

namespace pinocchio::app {

void Session::play_on(double turn_s) {
  if (!model_.scene.animation) return;
  if (Playback& playback = model_.playback; playback.playing) {
    const double length_s = duration_s(model_.scene);
    playback.time_s = length_s > 0.0 ? std::fmod(playback.time_s + turn_s, length_s) : 0.0;
  }
  take_pose();
  if (!posing() && posed_s_ != model_.playback.time_s) want_pose();
}

void Session::want_pose() {
  posed_from_ = model_.scene;
  pose_s_ = model_.playback.time_s;
  posed_s_ = pose_s_;
  pose_ = run_aside(kForFrames, [scene = posed_from_, seconds = pose_s_,
                                 settings = tree_of_.value_or(Settings{model_.drawn})] {
    return PoseAhead(scene).at(seconds, settings);
  });
}

// What was edited meanwhile is posed anew.
void Session::take_pose() {
  if (!posing() || pose_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  Expected<PoseAhead::Pose> pose = pose_.get();
  if (!pose) {
    model_.playback.playing = false;
    return model_.messages.error("animation", pose.error().message());
  }
  if (!(model_.scene == posed_from_) || model_.scene.animation != posed_from_.animation)
    return posed_s_.reset();
  model_.scene = std::move(pose->scene);
  applied_lights_ = model_.scene.lights;
  if (pose->tracer) model_.tracer = std::move(pose->tracer);
  redraws_ = std::max(redraws_, 1);
}

void Session::step_time(int frames) {
  if (!model_.scene.animation) return model_.messages.hint("the scene has no animation");
  Playback& playback = model_.playback;
  playback.playing = false;
  const double frame = std::round(playback.time_s * kUsualFps) + frames;
  playback.time_s = std::clamp(frame / kUsualFps, 0.0, duration_s(model_.scene));
}

}  // namespace pinocchio::app
