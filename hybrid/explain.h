#pragma once

#include <string>
#include <vector>

#include "hybrid/plan.h"

namespace pinocchio {

// Why the plan is as it is: one line a choice.
[[nodiscard]] std::vector<std::string> explain(const Needs& needs, const Plan& plan);

}  // namespace pinocchio
