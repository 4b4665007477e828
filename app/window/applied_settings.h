#pragma once

#include <vector>

#include "app/window/budget_control.h"
#include "app/window/scene/scene_source.h"

namespace pinocchio::app {

// Brings changed settings and lights into force where the scene can be drawn by them, else changes them back.
class AppliedSettings {
 public:
  AppliedSettings(Engine& engine, Model& model, Screen& screen, SceneSource& source, BudgetControl& budget)
      : engine_(engine), model_(model), screen_(screen), source_(source), budget_(budget) {}

  // Once a turn, with a scene.
  void update();
  // The lights of a new scene or pose, which update() can go back to.
  void set_lights(const std::vector<Light>& lights) { lights_ = lights; }
  [[nodiscard]] Expected<Settings> resolved(const Settings& wanted, const SceneStats& stats,
                                            bool keeps_mask) const;

 private:
  [[nodiscard]] bool apply(const ViewSettings& settings);

  Engine& engine_;
  Model& model_;
  Screen& screen_;
  SceneSource& source_;
  BudgetControl& budget_;
  std::vector<Light> lights_;  // in force
};

}  // namespace pinocchio::app
