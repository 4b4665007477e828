#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/window/model/settings.h"
#include "pinocchio/camera.h"
#include "pinocchio/environment.h"
#include "pinocchio/light.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"

namespace pinocchio::app {

// What a person can change and undo.
struct EditState {
  ViewSettings settings;
  Camera camera;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<MaterialMaps> maps;
  std::shared_ptr<const Environment> environment;
  std::vector<bool> hidden;  // parts

  friend bool operator==(const EditState&, const EditState&) = default;
};

// Undo and redo. Changes in quick succession are one step.
class EditHistory {
 public:
  // Adds the present state.
  void note(const EditState& state, double now_s);
  // Starts again with this state: nothing can be undone.
  void begin(const EditState& state);
  // The previous or next state, which becomes the present one. Nothing: there is none.
  [[nodiscard]] std::optional<EditState> undo();
  [[nodiscard]] std::optional<EditState> redo();

 private:
  static constexpr std::size_t kMost = 200;
  [[nodiscard]] std::optional<EditState> step(std::vector<EditState>& from, std::vector<EditState>& to);

  std::optional<EditState> now_;
  std::vector<EditState> before_, after_;
  double changed_s_ = -1e9;
};

}  // namespace pinocchio::app
