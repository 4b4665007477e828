// The program while the clock of the day jumps.
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

using ClockTest = ProgramTest;

constexpr const char* kJumping = "LD_PRELOAD='" JUMPING_CLOCK "'";

TEST_F(ClockTest, FiguresAreOfTheSteadyClock) {
  for (const char* mode : {"--mode raytrace", "--mode hybrid"}) {
    const CommandResult result = run("measure" + scene("cornell.gltf") + mode +
                                         " --size 48x36 --frames 8 --exchange pipelined --stats-json x.json",
                                     kJumping);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const nlohmann::json figures = nlohmann::json::parse(std::ifstream(folder_ / "x.json"));
    EXPECT_GT(figures["fps"].get<double>(), 0.01);
    EXPECT_LT(figures["fps"].get<double>(), 1e6);
    for (const auto& [stage, times] : figures["stages"].items()) {
      EXPECT_GE(times["ms"]["p50"].get<double>(), 0.0) << stage;
      EXPECT_LT(times["ms"]["p99"].get<double>(), 1e5) << stage;
    }
    EXPECT_LT(figures["latency"]["ms"]["p99"].get<double>(), 1e5);
  }
}

TEST_F(ClockTest, WorkThatStartsAgainKnowsItsFrames) {
  ASSERT_EQ(run("generate cornell -o x.gltf", kJumping).exit_code, 0);
  const std::string render =
      "render x.gltf --mode raytrace --size 32x24 --turntable 3 -o f#.exr --skip-existing";
  ASSERT_EQ(run(render, kJumping).exit_code, 0);
  const CommandResult again = run(render, kJumping);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("3 frames were there already"), std::string::npos) << again.out;
}

}  // namespace
}  // namespace pinocchio
