#pragma once

#include <filesystem>
#include <string_view>

#include "pinocchio/load.h"

namespace pinocchio {

// Adds a warning for every statement of an MTL file that is not read, and for every such option of a texture.
void add_lost_mtl_features(const std::filesystem::path& file, std::string_view text, Warnings& warnings);

}  // namespace pinocchio
