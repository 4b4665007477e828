// One way to draw, as a chart measures it.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "hybrid/frame.h"
#include "hybrid/plan.h"
#include "pinocchio/build_options.h"
#include "pinocchio/tracer.h"

namespace pinocchio::chart {

// As --tree has them, in SplitRule's order.
inline constexpr std::array kSplitRuleNames{"sah", "spatial-median", "object-median"};

// How the scene is made ready for the tracer.
struct TracerSettings {
  SplitRule tree = SplitRule::sah;
  std::optional<Isa> isa;
  TriangleTest triangle_test = BuildOptions{}.triangle_test;
  OffsetMethod offset = OffsetMethod::error_bound;

  friend bool operator==(const TracerSettings&, const TracerSettings&) = default;
};

// All that the cost and the error of a picture depend on beside scene, camera and size.
struct Settings {
  Plan plan;
  Exchange exchange = Exchange::sync;
  int spp = 1;
  TracerSettings tracer;
};
[[nodiscard]] nlohmann::json to_json(const Settings& settings);

struct Configuration {
  std::string axis, value;
  std::string options;         // that give it; files are named from the chart's folder. Empty: the default
  bool has_plan_file = false;  // plan_file() is among them
  Settings settings;
  // What it is measured against: "centre", one ray a pixel as most pictures have; "area", the mean over
  // the pixel, which is what more samples come closer to.
  std::string reference = "centre";

  // Of files about it: letters, digits, '.' and '-'.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string plan_file() const { return "plans/" + name() + ".json"; }
};

}  // namespace pinocchio::chart
