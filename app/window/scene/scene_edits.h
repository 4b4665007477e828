#pragma once

#include <optional>
#include <vector>

#include "app/window/model/model.h"
#include "app/window/scene/edit_history.h"

namespace pinocchio::app {

// What a person edits in the scene and in the settings, with undo and redo.
class SceneEdits {
 public:
  explicit SceneEdits(Model& model) : model_(model) {}

  // A new scene is in the model: there is nothing to undo.
  void begin();
  // Puts the overlay's edits into the scene.
  void apply();
  // Remembers the present state, for undo.
  void note();
  void undo();
  void redo();

 private:
  [[nodiscard]] EditState state() const;
  void restore(const std::optional<EditState>& state, const char* otherwise);
  void set_materials(std::vector<Material> materials);

  Model& model_;
  EditHistory history_;
};

}  // namespace pinocchio::app
