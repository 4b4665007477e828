#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pinocchio/settings.h"

namespace pinocchio {

// The settings and ways to draw the same scene for less, none twice: fewer samples of mask and reflection,
// fewer bounces, fewer bits, and in the end without mirrors or shadows. `exact` composites on the GPU, and
// is the first.
[[nodiscard]] std::vector<Settings> quality_ladder(const Settings& exact);

// What `settings` leave out of `exact`, in words; empty where nothing.
[[nodiscard]] std::string given_up(const Settings& exact, const Settings& settings);

// Settings and what they were measured to take and to cost in accuracy.
struct MeasuredSettings {
  Settings settings;
  double frame_ms = 0.0;
  double error = 0.0;  // against the exact ones' picture
};

// Those that no other beats in both time and error, slowest (and so most accurate) first.
[[nodiscard]] std::vector<MeasuredSettings> pareto_front(const std::vector<MeasuredSettings>& plans);

struct Budget {
  std::optional<double> frame_ms, error;
};

// Which of a front (not empty) to start with: the most accurate one that keeps both limits; the fastest one
// within `error` where none keeps both; without `frame_ms`, the fastest within `error`.
[[nodiscard]] std::size_t choose(const std::vector<MeasuredSettings>& front, const Budget& budget);

}  // namespace pinocchio
