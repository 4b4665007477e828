#include "app/window/screen/pace.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace pinocchio::app {
namespace {

nlohmann::json spread_ms(std::vector<double> seconds) {
  if (seconds.empty()) return {{"count", 0}};
  std::ranges::sort(seconds);
  const auto ms = [&](std::size_t i) { return 1e3 * seconds[i]; };
  return {{"count", seconds.size()},
          {"median_ms", ms(seconds.size() / 2)},
          {"p95_ms", ms(seconds.size() * 95 / 100)},
          {"worst_ms", ms(seconds.size() - 1)}};
}

}  // namespace

void Pace::polled(double begin_s, double end_s, bool any) {
  constexpr double kAtOnce_s = 1e-3;
  if (any && !waiting_since_s_)
    waiting_since_s_ = end_s - begin_s > kAtOnce_s || polled_s_ == 0.0 ? end_s : polled_s_;
  polled_s_ = end_s;
}

void Pace::redrawn(double at_s, bool loading) {
  if (waiting_since_s_) answers_s_.push_back(at_s - *waiting_since_s_);
  waiting_since_s_.reset();
  if (loading && loading_redraw_s_) loading_gaps_s_.push_back(at_s - *loading_redraw_s_);
  loading_redraw_s_.reset();
  if (loading) loading_redraw_s_ = at_s;
}

nlohmann::json Pace::json() const {
  nlohmann::json loading = spread_ms(loading_gaps_s_);
  const double loading_s = std::accumulate(loading_gaps_s_.begin(), loading_gaps_s_.end(), 0.0);
  loading["redraws_per_s"] = loading_s > 0.0 ? loading_gaps_s_.size() / loading_s : 0.0;
  return {{"input_to_display", spread_ms(answers_s_)}, {"between_redraws_while_loading", loading}};
}

}  // namespace pinocchio::app
