// The files that a verb reads and writes, and the options that name them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::app {

struct NamedFile {
  std::string role;  // "--stats-json", "the scene"
  std::filesystem::path file;
};

// Ends the verb with kUsage where an output is also an input or another output, also by links and relative
// names.
void check_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace pinocchio::app
