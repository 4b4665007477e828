#include "core/base/system_info.h"

#include <sys/resource.h>

#include <fstream>
#include <thread>

namespace pinocchio {

SystemInfo system_info() {
  SystemInfo info{"unknown", static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos && colon + 2 <= line.size()) info.cpu = line.substr(colon + 2);
    break;
  }
  return info;
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;  // Linux counts KiB
}

const char* version() {
  return PINOCCHIO_VERSION;
}

}  // namespace pinocchio
