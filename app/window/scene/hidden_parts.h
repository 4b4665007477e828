#pragma once

#include <memory>
#include <vector>

#include "app/window/model/model.h"

namespace pinocchio::app {

// Hides parts of the scene: their triangles shrink to points, so that all keep their ids.
class HiddenParts {
 public:
  explicit HiddenParts(Model& model) : model_(model) {}

  // A new scene is in the model: all its parts are shown.
  void begin();
  // Puts the overlay's choice into the scene. True: the scene needs another tree.
  bool apply();
  // The scene with all its parts.
  [[nodiscard]] Scene whole_scene() const;

 private:
  [[nodiscard]] std::size_t part_of(std::uint32_t triangle) const;

  Model& model_;
  std::vector<glm::uvec3> triangles_;  // with all parts
};

}  // namespace pinocchio::app
