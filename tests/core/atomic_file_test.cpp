#include "core/image/atomic_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pinocchio/error.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  std::filesystem::path folder_ = own_folder() / "atomic";
};

TEST_F(AtomicFile, ReplacesTheOldFileAsAWhole) {
  write_text(folder_ / "a.txt", "old");
  write_text(folder_ / "a.txt", "new");
  EXPECT_EQ(read("a.txt"), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, AFailureLeavesTheOldFileAndNothingElse) {
  write_text(folder_ / "a.txt", "old");
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(write_atomically(folder_ / "a.txt", fail), std::runtime_error);
  EXPECT_EQ(read("a.txt"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, SaysBeforehandWhatCannotBeWritten) {
  EXPECT_NO_THROW(check_writable(folder_ / "fine.txt"));
  EXPECT_EQ(files(), 0u);
  EXPECT_THROW(check_writable(folder_ / "nowhere" / "x.txt"), EnvironmentError);
  EXPECT_THROW(check_writable(folder_), EnvironmentError);
  EXPECT_THROW(check_writable("/dev/full"), EnvironmentError);
  EXPECT_THROW(check_writable("/proc/x.txt"), EnvironmentError);  // root or not
}

TEST_F(AtomicFile, ALinkToItselfIsRefusedAndKept) {
  std::filesystem::create_symlink("a.txt", folder_ / "a.txt");
  EXPECT_THROW(check_writable(folder_ / "a.txt"), EnvironmentError);
  EXPECT_THROW(write_text(folder_ / "a.txt", "text"), EnvironmentError);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "a.txt"));
}

}  // namespace
}  // namespace pinocchio
