// The program when an allocation fails: one line, exit code 1, no file that is half written.
#include <algorithm>

#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

constexpr long kTrials = 50;

class AllocationTest : public ProgramTest {
 protected:
  [[nodiscard]] CommandResult run_with(const std::string& variable, const std::string& arguments) const {
    return run(arguments, variable + " LD_PRELOAD='" FAILING_ALLOCATOR "'");
  }
  // That the program makes.
  [[nodiscard]] long allocations(const std::string& arguments) const {
    (void)run_with("ALLOCATIONS_FILE=scratch/count", arguments);
    long count = 0;
    std::ifstream(folder_ / "scratch/count") >> count;
    return count;
  }
};

TEST_F(AllocationTest, OneThatFailsIsOneLine) {
  const std::string how =
      "--mode raytrace --size 24x16 --threads 2 --frames 0-1 --turntable 2 --quiet -o x#.exr";
  ASSERT_EQ(run("generate cornell -o x.obj").exit_code, 0);  // read without nlohmann::json
  const std::string draw = "render x.obj " + how;
  // The allocations of the verb alone.
  const long first = allocations("render none.gltf " + how), last = allocations(draw);
  ASSERT_GT(last, first + 100);
  std::filesystem::remove(folder_ / "x0.exr");
  std::filesystem::remove(folder_ / "x1.exr");
  const std::size_t scene_files = files();
  int failures = 0;
  for (long n = first; n < last; n += std::max(1L, (last - first) / kTrials)) {
    std::filesystem::remove(folder_ / "x0.exr");
    std::filesystem::remove(folder_ / "x1.exr");
    const CommandResult result = run_with("FAILING_ALLOCATION=" + std::to_string(n), draw);
    const bool done = result.exit_code == 0;
    EXPECT_TRUE(done || result.exit_code == 1) << n << ": " << result.exit_code << "\n" << result.err;
    // A thread that could not be started is a warning.
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 1) << n << "\n" << result.err;
    EXPECT_TRUE(result.err.find("memory") != std::string::npos || (done && result.err.empty())) << n << "\n"
                                                                                                << result.err;
    EXPECT_LE(files(), scene_files + 2) << n;  // what is finished, and nothing beside it
    EXPECT_TRUE(!done || (exists("x0.exr") && exists("x1.exr"))) << n;
    if (!done) ++failures;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(failures, kTrials / 2);
}

}  // namespace
}  // namespace pinocchio
