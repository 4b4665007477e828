#pragma once

#include <filesystem>

#include "app/options.h"

namespace pinocchio::app {

struct StabilityRequest {
  std::filesystem::path folder;  // made where it is not there
  bool quick = false;            // a hundredth of the rays
  const DrawOptions* draw;       // context, progress and quiet
};

// `chart --stability`: drives every method to where methods fail, prints the table and
// writes it as stability.md, .csv and .json. Gives the exit code: kDone, kFailed where a default method
// failed, kInterrupted.
[[nodiscard]] int run_stability(const StabilityRequest& request);

}  // namespace pinocchio::app
