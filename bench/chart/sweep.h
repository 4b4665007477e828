// What a chart sweeps: every method that can be swapped, one axis at a time from the default, and some
// combinations.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hybrid/settings/scene_stats.h"
#include "pinocchio/error.h"

namespace pinocchio::chart {

// One way to draw, as a chart measures it.
struct Configuration {
  std::string axis, value;
  std::string options;  // of the command line, that give it; empty: the default
  Settings settings;    // resolved
  // What it is measured against: "centre", one ray a pixel as most pictures have; "area", the mean over
  // the pixel, which is what more samples come closer to.
  std::string reference = "centre";

  // Of files about it: letters, digits, '.' and '-'.
  [[nodiscard]] std::string name() const;
};

struct SweepRequest {
  Settings base;  // the default, resolved
  std::function<Expected<Settings>(const Settings&)> resolve;
  SceneStats stats;
  int cores = 1;
  bool quick = false;             // fewer points an axis
  std::vector<std::string> only;  // axes; empty: all
};

// The configurations of every axis, the default among them on each; what cannot draw the scene is left out.
// An axis on which the scene leaves nothing to choose has none (no mirrors: no formats of reflection).
[[nodiscard]] std::vector<Configuration> make_sweep(const SweepRequest& request);

struct AxisName {
  std::string_view name, title;
};
[[nodiscard]] std::vector<AxisName> axis_names();

}  // namespace pinocchio::chart
