#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace pinocchio::app {

// How quickly the window answers a person: what `view --stats-json` writes.
class Pace {
 public:
  // Events were asked for at `asked_s` and given at `given_s`. Those that were there at once came when the
  // window was busy: since it last looked, at worst.
  void looked(double asked_s, double given_s, bool any);
  // The window was drawn, with all events that were given before.
  void redrawn(double at_s, bool loading);

  // Of input that was answered and of redraws while a scene was loaded.
  [[nodiscard]] nlohmann::json json() const;

 private:
  double looked_s_ = 0.0;
  std::optional<double> waiting_since_s_;  // of the first event that is not answered yet
  std::vector<double> answers_s_;
  std::optional<double> loading_redraw_s_;  // the newest while a scene was loaded
  std::vector<double> loading_gaps_s_;
};

}  // namespace pinocchio::app
