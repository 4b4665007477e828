// The program where the system starts few threads.
#include <algorithm>

#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class ThreadsTest : public ProgramTest {
 protected:
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // One line, of threads.
  static void expect_warning(const std::string& err) {
    EXPECT_NE(err.find("pinocchio: warning: "), std::string::npos) << err;
    EXPECT_NE(err.find("started ("), std::string::npos) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  }
};

// Those of the trees, of poses made ahead, of tracing and of writing.
TEST_F(ThreadsTest, FramesAreTheSameWithAnyNumber) {
  const std::string draw = "render" + scene("windmill.glb") +
                           "--mode raytrace --size 48x32 --deterministic --threads 3 --frames 0-2 -o ";
  ASSERT_EQ(run(draw + "all_#.exr").exit_code, 0);
  for (const int threads : {0, 1, 2, 3, 6, 9}) {
    const CommandResult result = run(draw + "few_#.exr", "LIMITED_THREADS=" + std::to_string(threads) +
                                                             " LD_PRELOAD='" LIMITED_THREADS "'");
    EXPECT_EQ(result.exit_code, 0) << threads << ": " << result.err;
    expect_warning(result.err);
    for (const char* number : {"0", "1", "2"}) {
      const std::string all = bytes(std::string("all_") + number + ".exr");
      EXPECT_FALSE(all.empty());
      EXPECT_TRUE(all == bytes(std::string("few_") + number + ".exr")) << threads << ", frame " << number;
    }
  }
}

// Each thread has a stack of 8 MB: 1024 of them are more than there is, and leave the work its part.
TEST_F(ThreadsTest, ManyUnderALimitOfMemory) {
  const std::string draw =
      "render" + scene("cornell") + "--mode raytrace --size 48x32 --deterministic --threads 1024 -o ";
  ASSERT_EQ(run(draw + "all.exr").exit_code, 0);
  const CommandResult result = run(draw + "few.exr", "ulimit -v 2000000 &&");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  expect_warning(result.err);
  EXPECT_TRUE(bytes("all.exr") == bytes("few.exr"));
}

}  // namespace
}  // namespace pinocchio
