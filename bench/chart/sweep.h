// What a chart sweeps: every method that can be swapped, one axis at a time from the default, and some
// combinations.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/chart/configuration.h"
#include "pinocchio/error.h"

namespace pinocchio::chart {

struct SweepRequest {
  Needs needs;
  PlanRequest plan;  // of the default: hybrid, design 1
  int cores = 1;
  bool quick = false;             // fewer points an axis
  std::vector<std::string> only;  // axes; empty: all
};

// The configurations of every axis, the default among them on each. An axis on which the scene leaves
// nothing to choose has none (no mirrors: no formats of reflection).
[[nodiscard]] Expected<std::vector<Configuration>> make_sweep(const SweepRequest& request);

struct AxisName {
  std::string_view name, title;
};
[[nodiscard]] std::vector<AxisName> axis_names();

}  // namespace pinocchio::chart
