#pragma once

#include <set>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio {

// Layers of a frame's EXR beside its colour: Z, P, N, Albedo, id, shadow, reflection.
using AovSet = std::set<std::string>;

// "all", "none", or layers or channels of theirs, separated by commas ("Z,P,id.triangle").
[[nodiscard]] Expected<AovSet> parse_aovs(const std::string& text);

}  // namespace pinocchio
