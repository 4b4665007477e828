#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "hybrid/plan.h"

namespace pinocchio {

// A plan as people read, edit and give it back: every setting by its name in Plan.
[[nodiscard]] nlohmann::json to_json(const Plan& plan);

// The plan of a file: a plan's JSON, or an object that holds one under "plan" (as 'info --plan --json' and
// --stats-json write). A setting that is left out is as in a Plan{}. An error, with the line where it is
// known: the file cannot be read, is no JSON, has a setting or a value that is none, or a plan that cannot
// draw a scene of these needs.
[[nodiscard]] Expected<Plan> load_plan(const std::filesystem::path& file, const Needs& needs);

}  // namespace pinocchio
