#pragma once

#include <optional>
#include <vector>

#include "app/window/settings.h"
#include "pinocchio/camera.h"
#include "pinocchio/light.h"
#include "pinocchio/material.h"

namespace pinocchio::app {

// What a person can change and take back.
struct EditState {
  ViewSettings settings;
  Camera camera;
  std::vector<Light> lights;
  std::vector<Material> materials;

  friend bool operator==(const EditState&, const EditState&) = default;
};

// Undo and redo. Changes that follow each other at once are one step.
class EditHistory {
 public:
  // The state as it is now.
  void note(const EditState& state, double now_s);
  // Of another scene: nothing can be taken back.
  void begin(const EditState& state);
  // The state before or after, which becomes the present one; nothing: there is none.
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
