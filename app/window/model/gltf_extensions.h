#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::app {

// The extensions that a glTF file says it uses. Empty: none, or the file has another format.
[[nodiscard]] std::vector<std::string> gltf_extensions(const std::filesystem::path& file);

}  // namespace pinocchio::app
