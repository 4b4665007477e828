#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace pinocchio {

// A folder of the running test's own, as ctest runs tests side by side; gone when the program ends.
inline std::filesystem::path own_folder() {
  struct Root {
    std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("pinocchio-test-" + std::to_string(getpid()));
    ~Root() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Root root;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = root.path / (std::string(test.test_suite_name()) + "." + test.name());
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path own_file(const std::string& name) {
  return own_folder() / name;
}

}  // namespace pinocchio
