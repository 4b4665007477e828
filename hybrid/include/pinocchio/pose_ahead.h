// An animated scene, frame after frame.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "pinocchio/animation.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// Gives the scene's poses with their trees, and makes the next one on a thread of its own meanwhile. What a
// pose is made of does not depend on those before it.
class PoseAhead {
 public:
  struct Pose {
    Scene scene;
    std::shared_ptr<const Tracer> tracer;  // null where the settings trace nothing
  };

  // `progress`, which may be null, ends what is begun once it is cancelled.
  explicit PoseAhead(Scene scene, Progress* progress = nullptr)
      : scene_(std::move(scene)), progress_(progress) {}
  // Cancels the pose that is being made ahead.
  ~PoseAhead();
  PoseAhead(PoseAhead&&) noexcept = default;
  PoseAhead& operator=(PoseAhead&&) = delete;

  // The pose at that time, for frames of these resolved settings. `next_s`: the time that will be asked for
  // next, if it is known.
  [[nodiscard]] Expected<Pose> at(double seconds, const Settings& settings,
                                  std::optional<double> next_s = {});

  // How far the pose is that was begun ahead last; null: none was.
  [[nodiscard]] std::shared_ptr<const Progress> next_progress() const { return next_progress_; }

 private:
  struct Wanted {
    double seconds;
    Settings settings;

    // Whether a pose made for the one is the other's.
    [[nodiscard]] bool same_as(const Wanted& other) const;
  };
  void begin(const Wanted& wanted);
  [[nodiscard]] Expected<Pose> made_ahead();
  void drop_next();
  [[nodiscard]] static Expected<Pose> make(const Scene& scene, const Wanted& wanted, Progress* progress);

  Scene scene_;
  Progress* progress_;
  std::optional<Wanted> last_wanted_, next_wanted_;
  std::optional<Pose> last_;
  std::shared_ptr<Progress> next_progress_;
  std::future<Expected<Pose>> next_;  // of next_wanted_; its destructor waits
};

}  // namespace pinocchio
