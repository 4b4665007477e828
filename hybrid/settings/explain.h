#pragma once

#include <string>
#include <vector>

#include "hybrid/settings/scene_stats.h"

namespace pinocchio {

// Why the resolved settings are as they are: one line a choice.
[[nodiscard]] std::vector<std::string> explain(const SceneStats& stats, const Settings& s);

}  // namespace pinocchio
