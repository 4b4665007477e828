#include "app/window/scene/playback.h"

#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "app/cli/console.h"
#include "app/run/animation.h"
#include "app/window/scene/clips.h"
#include "core/parallel/start_thread.h"
#include "pinocchio/animation.h"

namespace pinocchio::app {
namespace {

// Without memory or a thread there is no pose, but the window stays open.
Expected<PoseAhead::Pose> pose_of(std::future<Expected<PoseAhead::Pose>>& pose) {
  try {
    return pose.get();
  } catch (const std::bad_alloc&) {
    return Unexpected(InputError{"", 0, "out of memory for the tree of this pose", ""});
  } catch (const std::exception& error) {
    return Unexpected(InputError{"", 0, one_line(error.what()), ""});
  }
}

}  // namespace

void Playback::begin() {
  model_.playback.all = model_.scene.animation;
  model_.playback.clip = clip_ = -1;
  rest_ = model_.scene.nodes;
}

void Playback::change_clip() {
  PlaybackState& state = model_.playback;
  if (state.clip == clip_ || !state.all || !rest_) return;
  cancel();
  clip_ = state.clip;
  model_.scene.animation = clip_ < 0 ? state.all : clip_of(*state.all, clip_, *rest_);
  state.time_s = 0.0;
  state.posed_s.reset();
}

bool Playback::advance(double turn_s, const Settings& tree_settings) {
  if (!model_.scene.animation) return false;
  change_clip();
  if (PlaybackState& state = model_.playback; state.playing) {
    const double length_s = duration_s(model_.scene);
    state.time_s = length_s > 0.0 ? std::fmod(state.time_s + state.speed * turn_s, length_s) : 0.0;
  }
  const bool posed = receive_pose();
  if (!is_posing() && model_.playback.posed_s != model_.playback.time_s) begin_pose(tree_settings);
  return posed;
}

void Playback::begin_pose(const Settings& tree_settings) {
  posed_from_ = model_.scene;
  model_.playback.posed_s = model_.playback.time_s;
  progress_ = std::make_shared<pinocchio::Progress>();
  pose_ = run_aside(kForFrames, [scene = posed_from_, time_s = model_.playback.time_s, progress = progress_,
                                 before = model_.tracer, tree_settings] {
    return PoseAhead(scene, progress.get(), before).at(time_s, tree_settings);
  });
}

void Playback::cancel() {
  if (!is_posing()) return;
  progress_->cancel();
  pose_ = {};
  model_.playback.posed_s.reset();
}

// A scene that was edited meanwhile is posed again.
bool Playback::receive_pose() {
  if (!is_posing() || pose_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  Expected<PoseAhead::Pose> pose = pose_of(pose_);
  if (!pose) {
    model_.playback.playing = false;
    model_.messages.error("animation", pose.error().message());
    return false;
  }
  if (!(model_.scene == posed_from_) || model_.scene.animation != posed_from_.animation) {
    model_.playback.posed_s.reset();
    return false;
  }
  model_.scene = std::move(pose->scene);
  if (pose->tracer) model_.tracer = std::move(pose->tracer);
  return true;
}

void Playback::toggle() {
  if (!model_.scene.animation) return model_.messages.hint("the scene has no animation");
  model_.playback.playing = !model_.playback.playing;
}

void Playback::step(int frames) {
  if (!model_.scene.animation) return model_.messages.hint("the scene has no animation");
  PlaybackState& state = model_.playback;
  state.playing = false;
  const double frame = std::round(state.time_s * kUsualFps) + frames;
  state.time_s = std::clamp(frame / kUsualFps, 0.0, duration_s(model_.scene));
}

}  // namespace pinocchio::app
