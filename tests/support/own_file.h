#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace pinocchio {

// A path in a folder of the running test's own: ctest runs tests side by side.
inline std::filesystem::path own_file(const std::string& name) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / (std::string(test.test_suite_name()) + "." + test.name());
  std::filesystem::create_directories(folder);
  return folder / name;
}

}  // namespace pinocchio
