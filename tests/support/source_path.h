#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pinocchio {

// Returns the path of a file of the sources. They may lie elsewhere than where the tests were compiled:
// scripts/gpu says where.
inline std::filesystem::path source_path(const std::string& name) {
  const char* folder = std::getenv("PINOCCHIO_SOURCE_DIR");
  return std::filesystem::path(folder ? folder : PINOCCHIO_SOURCE_DIR) / name;
}

}  // namespace pinocchio
