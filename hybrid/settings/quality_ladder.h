#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pinocchio/settings.h"

namespace pinocchio {

// The exact settings, which composite on the GPU, and cheaper ones, each once: fewer samples of mask and
// reflection, fewer bounces, fewer bits, and last no mirrors or shadows. lights_in_reflection: adds_lights().
[[nodiscard]] std::vector<Settings> quality_ladder(const Settings& exact, bool lights_in_reflection = false);

// The losses of `settings` against `exact`, in words; empty: none.
[[nodiscard]] std::string given_up(const Settings& exact, const Settings& settings);

// Settings with their measured time and error.
struct MeasuredSettings {
  Settings settings;
  double frame_ms = 0.0;
  double error = 0.0;  // against the exact ones' picture
};

// The settings that no other beats in both time and error, slowest (and so most accurate) first.
[[nodiscard]] std::vector<MeasuredSettings> pareto_front(const std::vector<MeasuredSettings>& plans);

struct Budget {
  std::optional<double> frame_ms, error;
};

// The first choice of a front (not empty): the most accurate one within both limits; the fastest one within
// `error` where none is within both, or without `frame_ms`.
[[nodiscard]] std::size_t choose(const std::vector<MeasuredSettings>& front, const Budget& budget);

}  // namespace pinocchio
