#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace pinocchio {

struct SystemInfo {
  std::string cpu;  // model name; "unknown" if the system does not say
  int cores = 1;    // that this process may use
};

[[nodiscard]] SystemInfo system_info();

// The first processor's name in the text of Linux's /proc/cpuinfo: x86 writes a name, Arm numbers.
[[nodiscard]] std::string processor_name(std::istream& cpuinfo);

// The peak memory of this process in bytes, including pages of its program and libraries.
[[nodiscard]] std::size_t peak_memory_bytes();

// The project's version, as in the EXR and --version.
[[nodiscard]] const char* version();

}  // namespace pinocchio
