#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace pinocchio::app {

// How quickly the window responds to input, for `view --stats-json`.
class Pace {
 public:
  // Events were polled from `begin_s` to `end_s`. Events that were there at once came while the window was
  // busy: at worst since the poll before.
  void polled(double begin_s, double end_s, bool any);
  // The window was drawn, with all events that were polled before.
  void redrawn(double at_s, bool loading);

  [[nodiscard]] nlohmann::json json() const;

 private:
  double polled_s_ = 0.0;
  std::optional<double> waiting_since_s_;  // of the first event that is not shown yet
  std::vector<double> answers_s_;
  std::optional<double> loading_redraw_s_;  // the newest while a scene was loaded
  std::vector<double> loading_gaps_s_;
};

}  // namespace pinocchio::app
