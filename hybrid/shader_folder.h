#pragma once

#include <filesystem>

namespace pinocchio {

// Where the shaders are: beside an installed program (../share/pinocchio/shaders), else in the source
// tree it was built from. PINOCCHIO_SHADERS names another folder.
[[nodiscard]] std::filesystem::path shader_folder();

}  // namespace pinocchio
