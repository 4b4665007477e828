#pragma once

#include <string>
#include <vector>

#include "hybrid/settings/scene_stats.h"

namespace pinocchio {

// The reasons for the resolved settings, one line a choice.
[[nodiscard]] std::vector<std::string> explain(const SceneStats& stats, const Settings& s);

}  // namespace pinocchio
