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
  // Light from all directions, instead of the scene's own and of the light that it was given for lack of one.
  // Null: none.
  void set_environment(std::shared_ptr<const Environment> environment);
  // The edits are in a file now.
  void saved();
  // Remembers the present state, for undo.
  void note();
  void undo();
  void redo();

 private:
  [[nodiscard]] EditState state() const;
  [[nodiscard]] std::vector<Light> lights_at_rest() const;
  template <class Use>
  void for_each_moving(Scene& scene, Use use) const;
  void restore(const std::optional<EditState>& state, const char* otherwise);
  void set_materials(std::vector<Material> materials, std::vector<MaterialMaps> maps);

  void note_edit();

  Model& model_;
  EditHistory history_;
  std::vector<bool> moving_;  // by node: the animation moves it. Empty: there is none
  // What the file holds.
  std::vector<Light> saved_lights_;
  std::vector<Material> saved_materials_;
};

}  // namespace pinocchio::app
