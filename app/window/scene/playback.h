#pragma once

#include <future>
#include <memory>

#include "app/window/model/model.h"
#include "pinocchio/pose_ahead.h"

namespace pinocchio::app {

// Moves an animated scene through its time. Each pose and its tree are made on a thread of their own, while
// frames of the pose before are drawn.
class Playback {
 public:
  explicit Playback(Model& model) : model_(model) {}
  ~Playback() { cancel(); }

  // A new scene is in the model.
  void begin();
  // Moves on by `turn_s`. tree_settings: for the tree of the next pose. True: another pose is in the model.
  bool advance(double turn_s, const Settings& tree_settings);
  void toggle();
  void step(int frames);
  // Drops the pose that is being made.
  void cancel();
  [[nodiscard]] bool is_posing() const { return pose_.valid(); }

 private:
  void change_clip();
  bool receive_pose();
  void begin_pose(const Settings& tree_settings);

  Model& model_;
  std::shared_ptr<const NodeTree> rest_;  // as the file has it
  int clip_ = -1;                         // that the scene's animation is
  std::shared_ptr<pinocchio::Progress> progress_;
  std::future<Expected<PoseAhead::Pose>> pose_;  // being made
  Scene posed_from_;                             // the scene that pose_ is made from
};

}  // namespace pinocchio::app
