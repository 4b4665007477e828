#include "core/base/system_info.h"

#include <gtest/gtest.h>

#include <sstream>

namespace pinocchio {
namespace {

std::string name_in(const std::string& cpuinfo) {
  std::istringstream in(cpuinfo);
  return processor_name(in);
}

TEST(SystemInfo, NamesTheProcessorOfEachArchitecture) {
  EXPECT_EQ(name_in("processor\t: 0\nmodel\t\t: 17\nmodel name\t: AMD EPYC 9B14\n\nprocessor\t: 1\n"),
            "AMD EPYC 9B14");
  const std::string arm =
      "processor\t: 0\nCPU implementer\t: 0x41\nCPU architecture: 8\nCPU variant\t: 0x3\n";
  EXPECT_EQ(name_in(arm + "CPU part\t: 0xd0c\n\nprocessor\t: 1\nCPU part\t: 0xd40\n"), "Arm Neoverse-N1");
  EXPECT_EQ(name_in(arm + "CPU part\t: 0xfff\n"), "Arm, implementer 0x41, part 0xfff");
  EXPECT_EQ(name_in("CPU implementer\t: 0x61\nCPU part\t: 0x022\n"), "Arm, implementer 0x61, part 0x022");
  EXPECT_EQ(name_in("model name\t: \n"), "");
  EXPECT_EQ(name_in(""), "unknown");
}

}  // namespace
}  // namespace pinocchio
