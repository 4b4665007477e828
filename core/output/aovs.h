#pragma once

#include <set>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio {

// Layers of a frame's EXR beside its colour, by their names in kLayers (pinocchio/frame_arrays.h).
using AovSet = std::set<std::string>;

// "all" (those that are not by_name_only), "none", or layers or their channels, separated by commas
// ("Z,P,id.triangle"). "all" may be one of several ("all,id.node").
[[nodiscard]] Expected<AovSet> parse_aovs(const std::string& text);

// The names of all layers, for people.
[[nodiscard]] std::string aov_names();

}  // namespace pinocchio
