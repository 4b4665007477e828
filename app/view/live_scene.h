#pragma once

#include <memory>
#include <vector>

#include "hybrid/needs.h"
#include "hybrid/prepared_scene.h"

namespace pinocchio::app {

// The scene that is shown, whose lights may change from frame to frame while older frames are in flight:
// each frame keeps the scene it was begun with. Copies share tree and GPU buffers, and one that no frame
// uses any more is used again, so there are never more than frames in flight.
class LiveScene {
 public:
  // A new scene, with GPU buffers, perhaps still without its tree, and its needs.
  void set_scene(std::shared_ptr<PreparedScene> scene, const Needs& needs);
  // No frame in flight traces before this.
  void set_tracer(const std::shared_ptr<const Tracer>& tracer);
  // Of the scene that is shown; casting: false lets none cast a shadow.
  void set_lights(const std::vector<Light>& lights, bool casting);

  explicit operator bool() const { return shown_ != nullptr; }
  [[nodiscard]] const std::shared_ptr<PreparedScene>& shown() const { return shown_; }
  [[nodiscard]] const Needs& needs() const { return needs_; }

 private:
  std::shared_ptr<PreparedScene> shown_;
  std::vector<std::shared_ptr<PreparedScene>> all_;  // shown_ and its copies
  Needs needs_;                                      // of shown_
};

}  // namespace pinocchio::app
