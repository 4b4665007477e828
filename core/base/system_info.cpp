#include "core/base/system_info.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <thread>
#include <utility>

#include "pinocchio/conversion.h"

namespace pinocchio {

namespace {

// Cores of servers and small computers, by the number that Linux shows as "CPU part" (implementer 0x41, Arm).
constexpr std::pair<std::string_view, std::string_view> kArmCores[]{
    {"0xd03", "Cortex-A53"},  {"0xd05", "Cortex-A55"},  {"0xd07", "Cortex-A57"},  {"0xd08", "Cortex-A72"},
    {"0xd0b", "Cortex-A76"},  {"0xd0c", "Neoverse-N1"}, {"0xd40", "Neoverse-V1"}, {"0xd49", "Neoverse-N2"},
    {"0xd4f", "Neoverse-V2"}, {"0xd84", "Neoverse-V3"}, {"0xd8e", "Neoverse-N3"}};

std::string arm_name(std::string_view implementer, std::string_view part) {
  if (implementer == "0x41")
    for (const auto& [number, name] : kArmCores)
      if (number == part) return "Arm " + std::string(name);
  return "Arm, implementer " + std::string(implementer) + ", part " + std::string(part);
}

}  // namespace

std::string processor_name(std::istream& cpuinfo) {
  std::string implementer, part;
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string value = line.substr(colon + 2);
    if (line.starts_with("model name")) return value;
    if (line.starts_with("CPU implementer") && implementer.empty()) implementer = value;
    if (line.starts_with("CPU part") && part.empty()) part = value;
  }
  return part.empty() ? "unknown" : arm_name(implementer, part);
}

SystemInfo system_info() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  return {processor_name(cpuinfo), as_int(std::max(1u, std::thread::hardware_concurrency()))};
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
