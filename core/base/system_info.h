#pragma once

#include <string>

namespace pinocchio {

struct SystemInfo {
  std::string cpu;  // model name, "unknown" where the system does not tell
  int cores = 1;    // that this process may use
};

[[nodiscard]] SystemInfo system_info();

// The project's version, as in the EXR and --version.
[[nodiscard]] const char* version();

}  // namespace pinocchio
