// The configurations of a chart: every method that can be swapped, one axis at a time from the default, and
// some combinations.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hybrid/settings/scene_stats.h"
#include "pinocchio/error.h"

namespace pinocchio::chart {

// A way to draw that a chart measures.
struct Configuration {
  std::string axis, value;
  std::string options;  // the command line's options for it; empty: the default
  Settings settings;    // resolved
  // The reference: "centre" has one ray for each pixel, as most pictures; "area" is the mean over the pixel,
  // which more samples approach.
  std::string reference = "centre";

  // For names of files: letters, digits, '.' and '-'.
  [[nodiscard]] std::string name() const;
};

struct SweepRequest {
  Settings base;  // the default, resolved
  std::function<Expected<Settings>(const Settings&)> resolve;
  SceneStats stats;
  int cores = 1;
  bool quick = false;             // fewer points on each axis
  std::vector<std::string> only;  // axes; empty: all
};

// The configurations of all axes, each with the default. Configurations that cannot draw the scene are left
// out. An axis without a choice has none (no mirrors: no formats of reflection).
[[nodiscard]] std::vector<Configuration> make_sweep(const SweepRequest& request);

struct AxisName {
  std::string_view name, title;
};
[[nodiscard]] std::vector<AxisName> axis_names();

}  // namespace pinocchio::chart
