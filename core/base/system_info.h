#pragma once

#include <cstddef>
#include <string>

namespace pinocchio {

struct SystemInfo {
  std::string cpu;  // model name, "unknown" where the system does not tell
  int cores = 1;    // that this process may use
};

[[nodiscard]] SystemInfo system_info();

// The most memory that this process has had at a time, bytes; pages of its program and libraries included.
[[nodiscard]] std::size_t peak_memory_bytes();

// The project's version, as in the EXR and --version.
[[nodiscard]] const char* version();

}  // namespace pinocchio
