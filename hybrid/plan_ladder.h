#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hybrid/plan.h"

namespace pinocchio {

// The plan and ways to draw the same scene for less, none twice: fewer samples of mask and reflection,
// fewer bounces, fewer bits, and in the end without mirrors or shadows. `exact` is hybrid design 1's, and the
// first.
[[nodiscard]] std::vector<Plan> cheaper_plans(const Plan& exact);

// What `plan` leaves out of `exact`, in words; empty where nothing.
[[nodiscard]] std::string given_up(const Plan& exact, const Plan& plan);

// A plan and what it was measured to take and to cost in accuracy.
struct MeasuredPlan {
  Plan plan;
  double frame_ms = 0.0;
  double error = 0.0;  // against the exact plan's picture
};

// Those that no other beats in both time and error, slowest (and so most accurate) first.
[[nodiscard]] std::vector<MeasuredPlan> pareto_front(const std::vector<MeasuredPlan>& plans);

struct Budget {
  std::optional<double> frame_ms, error;
};

// Which of a front (not empty) to start with: the most accurate one that keeps both limits; the fastest one
// within `error` where none keeps both; without `frame_ms`, the fastest within `error`.
[[nodiscard]] std::size_t choose(const std::vector<MeasuredPlan>& front, const Budget& budget);

}  // namespace pinocchio
