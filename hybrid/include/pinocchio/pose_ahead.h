// The poses of an animated scene, frame after frame.
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

// Returns the scene's poses with their trees. Meanwhile it makes the next pose on a thread of its own. A pose
// does not depend on earlier ones, but keeps their trees where they still serve.
class PoseAhead {
 public:
  struct Pose {
    Scene scene;
    std::shared_ptr<const Tracer> tracer;  // null: the settings trace nothing
  };

  // `progress`, which may be null, cancels work that has begun. `before`: a tracer of any of the poses.
  explicit PoseAhead(Scene scene, Progress* progress = nullptr,
                     std::shared_ptr<const Tracer> before = nullptr)
      : scene_(std::move(scene)), progress_(progress), before_(std::move(before)) {}
  // Cancels the pose that is being made ahead.
  ~PoseAhead();
  PoseAhead(PoseAhead&&) noexcept = default;
  PoseAhead& operator=(PoseAhead&&) = delete;

  // The pose at that time, for frames with these resolved settings. `next_s`: the time of the next request,
  // if it is known.
  [[nodiscard]] Expected<Pose> at(double seconds, const Settings& settings,
                                  std::optional<double> next_s = {});

  // The progress of the pose that was last begun ahead; null: none was.
  [[nodiscard]] std::shared_ptr<const Progress> next_progress() const { return next_progress_; }

 private:
  struct Wanted {
    double seconds;
    Settings settings;

    // Whether a pose made for one is valid for the other.
    [[nodiscard]] bool same_as(const Wanted& other) const;
  };
  void begin(const Wanted& wanted);
  [[nodiscard]] Expected<Pose> made_ahead();
  void drop_next();
  [[nodiscard]] static Expected<Pose> make(const Scene& scene, const Wanted& wanted, const Tracer* before,
                                           Progress* progress);

  Scene scene_;
  Progress* progress_;
  std::shared_ptr<const Tracer> before_;  // the last pose's
  std::optional<Wanted> last_wanted_, next_wanted_;
  std::optional<Pose> last_;
  std::shared_ptr<Progress> next_progress_;
  std::future<Expected<Pose>> next_;  // of next_wanted_; its destructor waits
};

}  // namespace pinocchio
