#pragma once

#include "app/view/actions.h"
#include "hybrid/frame.h"
#include "hybrid/plan.h"

namespace pinocchio::app {

enum class PlanSource {
  automatic,  // what the scene needs
  slides,
  file,  // of the command line; says mode, design and depth, too
};

// What a person at the window can change while it draws.
struct ViewSettings {
  Mode mode = Mode::hybrid;
  int design = 1;
  Exchange exchange = Exchange::pipelined;
  PlanSource plan = PlanSource::automatic;
  bool has_plan_file = false;
  bool shadows = true;  // off: no light casts
  bool reflections = true;
  int depth = 8;
  float exposure_ev = 0.0f;  // stops
  float scale = 1.0f;        // pixels drawn for one of the window's, along a side
  bool vsync = true;
  bool accumulate = true;  // a still camera gathers samples
  bool overlay = true;
  bool help = false;
};

// Limits of what the controls set.
inline constexpr float kLeastScale = 0.125f, kMostScale = 2.0f;
inline constexpr float kMostExposure = 16.0f;  // stops, either way
inline constexpr int kMostDepth = 64;

// What an action that is about settings does to them; others do nothing.
void change_setting(Action action, ViewSettings& settings);

// What the settings ask of a plan.
[[nodiscard]] PlanRequest plan_request(const ViewSettings& settings);

// The settings as they can be had: reprojection needs design 1, and values keep to their limits.
[[nodiscard]] ViewSettings possible(ViewSettings settings);

}  // namespace pinocchio::app
