#include "pinocchio/pose_ahead.h"

#include <new>
#include <utility>

#include "core/parallel/start_thread.h"
#include "pinocchio/engine.h"

namespace pinocchio {

bool PoseAhead::Wanted::same_as(const Wanted& other) const {
  return seconds == other.seconds && settings.traces() == other.settings.traces() &&
         same_tracer(settings, other.settings);
}

Expected<PoseAhead::Pose> PoseAhead::make(const Scene& scene, const Wanted& wanted, const Tracer* before,
                                          Progress* progress) {
  throw_if_cancelled(progress);
  Expected<Scene> posed = at_time(scene, wanted.seconds);
  if (!posed) return Unexpected(posed.error());
  std::shared_ptr<const Tracer> tracer = Engine::prepare(*posed, wanted.settings, progress, nullptr, before);
  return Pose{std::move(*posed), std::move(tracer)};
}

Expected<PoseAhead::Pose> PoseAhead::at(double seconds, const Settings& settings,
                                        std::optional<double> next_s) {
  const Wanted wanted{seconds, settings};
  if (!last_wanted_ || !last_wanted_->same_as(wanted)) {
    const bool is_begun = next_.valid() && next_wanted_->same_as(wanted);
    if (!is_begun) drop_next();
    Expected<Pose> pose = is_begun ? made_ahead() : make(scene_, wanted, before_.get(), progress_);
    if (!pose) return pose;
    last_wanted_.reset();  // until last_ is set
    last_ = std::move(*pose);
    if (last_->tracer) before_ = last_->tracer;
    last_wanted_ = wanted;
  }
  if (next_s && *next_s != seconds) begin({*next_s, settings});
  return *last_;
}

// Out of memory beside the frame that was drawn meanwhile: there may be enough now.
Expected<PoseAhead::Pose> PoseAhead::made_ahead() {
  try {
    return next_.get();
  } catch (const std::bad_alloc&) {
    return make(scene_, *next_wanted_, before_.get(), progress_);
  }
}

void PoseAhead::begin(const Wanted& wanted) {
  if (next_.valid() && next_wanted_->same_as(wanted)) return;
  drop_next();
  next_wanted_ = wanted;
  next_progress_ = std::make_shared<Progress>(progress_);
  next_ = run_aside(0, [scene = scene_, wanted, before = before_, progress = next_progress_] {
    return make(scene, wanted, before.get(), progress.get());
  });
}

void PoseAhead::drop_next() {
  if (!next_.valid()) return;
  next_progress_->cancel();
  next_ = {};
}

PoseAhead::~PoseAhead() {
  drop_next();
}

}  // namespace pinocchio
