// Animated scenes: each pose with its tree is made on a thread of its own, while frames of the one before are
// drawn.
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "app/animation.h"
#include "app/console.h"
#include "app/window/session.h"
#include "core/parallel/start_thread.h"
#include "pinocchio/animation.h"

namespace pinocchio::app {
namespace {

// Without memory or a thread for it there is no pose, and the window stays.
Expected<PoseAhead::Pose> finished(std::future<Expected<PoseAhead::Pose>>& pose) {
  try {
    return pose.get();
  } catch (const std::bad_alloc&) {
    return Unexpected(InputError{"", 0, "out of memory for the tree of this moment", ""});
  } catch (const std::exception& error) {
    return Unexpected(InputError{"", 0, one_line(error.what()), ""});
  }
}

}  // namespace

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
  pose_progress_ = std::make_shared<pinocchio::Progress>();
  pose_ = run_aside(kForFrames, [scene = posed_from_, seconds = pose_s_, progress = pose_progress_,
                                 settings = tree_of_.value_or(Settings{model_.drawn})] {
    return PoseAhead(scene, progress.get()).at(seconds, settings);
  });
}

void Session::drop_pose() {
  if (!posing()) return;
  pose_progress_->cancel();
  pose_ = {};
  posed_s_.reset();
}

// What was edited meanwhile is posed anew.
void Session::take_pose() {
  if (!posing() || pose_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Expected<PoseAhead::Pose> pose = finished(pose_);
  if (!pose) {
    model_.playback.playing = false;
    return model_.messages.error("animation", pose.error().message());
  }
  if (!(model_.scene == posed_from_) || model_.scene.animation != posed_from_.animation)
    return posed_s_.reset();
  model_.scene = pose->scene;
  applied_lights_ = model_.scene.lights;
  if (pose->tracer) model_.tracer = pose->tracer;
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
