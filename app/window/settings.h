#pragma once

#include "app/window/actions.h"
#include "hybrid/frame.h"
#include "hybrid/inspect_pass.h"
#include "hybrid/plan.h"

namespace pinocchio::app {

enum class PlanSource {
  automatic,  // what the scene needs
  slides,
  file,  // of the command line; says mode, design and depth, too
};

// What the window's right half shows.
enum class Split { off, reference, heat_map };

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
  BufferView buffer = BufferView::picture;
  int mask_slot = 0;  // of the buffer view
  Split split = Split::off;
  float split_at = 0.5f;   // of the window's width
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

// The next of the buffers to look at; of the mask, one of `mask_slots` after the other.
void next_buffer(ViewSettings& settings, int mask_slots);

// What the settings ask of a plan.
[[nodiscard]] PlanRequest plan_request(const ViewSettings& settings);

// The settings as they can be had: reprojection needs design 1, and values keep to their limits.
[[nodiscard]] ViewSettings possible(ViewSettings settings);

}  // namespace pinocchio::app
