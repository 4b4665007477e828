// --time, --fps and --frames of a scene that moves: scenes/windmill.glb.
#include <nlohmann/json.hpp>

#include "pinocchio/exr.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class AnimatedTest : public ProgramTest {
 protected:
  CommandResult render(const std::string& arguments) {
    CommandResult result = run("render" + scene("windmill.glb") + "--size 80x60 " + arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
    return result;
  }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] ExrFile exr(const std::string& name) const { return read_exr(folder_ / name).value(); }
  // Without what the header says of frame and number of frames.
  void expect_same_pixels(const std::string& a, const std::string& b, bool same = true) const {
    const ExrFile left = exr(a), right = exr(b);
    bool equal = left.channels.size() == right.channels.size();
    for (std::size_t i = 0; equal && i < left.channels.size(); ++i)
      equal = left.channels[i].values == right.channels[i].values &&
              left.channels[i].uints == right.channels[i].uints;
    EXPECT_EQ(equal, same) << a << " " << b;
  }
};

// However it is drawn: alone or among others, by one thread or three, in flight or waited for.
TEST_F(AnimatedTest, AFrameAloneIsTheSameFrameOfARange) {
  for (const std::string mode : {"--mode raytrace ", "--mode hybrid "}) {
    render(mode + "--quiet --deterministic --frames 0-24x6 --exchange pipelined -o r####.exr");
    render(mode + "--quiet --deterministic --frames 18 --threads 3 --exchange sync -o alone.exr");
    render(mode + "--quiet --deterministic --frames 6 --exchange pipelined -o six.exr");
    render(mode + "--quiet --deterministic --time 0.75 -o time.exr");
    expect_same_pixels("r0018.exr", "alone.exr");
    expect_same_pixels("r0018.exr", "time.exr");
    expect_same_pixels("r0006.exr", "r0018.exr", false);
    expect_same_pixels("r0000.exr", "r0006.exr", false);
    EXPECT_TRUE(bytes("six.exr") == bytes("r0006.exr"));  // the whole file
  }
}

TEST_F(AnimatedTest, TheHeaderSaysWhenItIs) {
  const auto time_of = [&](const std::string& name) {
    return std::get<float>(exr(name).attributes["pinocchio.time"]);
  };
  render("--mode raytrace --quiet --fps 8 --frames 0-12x12 -o f####.exr");
  EXPECT_FLOAT_EQ(time_of("f0012.exr"), 1.5f);
  EXPECT_EQ(std::get<ExrRational>(exr("f0012.exr").attributes["framesPerSecond"]), (ExrRational{8, 1}));
  render("--mode raytrace --quiet --time 1.5 --frames 3 -o t.exr");
  EXPECT_FLOAT_EQ(time_of("t.exr"), 1.5f);
  expect_same_pixels("t.exr", "f0012.exr");
  // A time that is named holds for all frames: the camera goes round what stands still.
  render("--mode raytrace --quiet --time 1.5 --turntable 4 -o o####.exr");
  expect_same_pixels("o0000.exr", "t.exr");
  EXPECT_FLOAT_EQ(time_of("o0003.exr"), 1.5f);
}

TEST_F(AnimatedTest, ExistingFramesAreThoseOfTheSameTime) {
  render("--mode raytrace --quiet --frames 0-3 -o s####.exr");
  const auto skipped = [&](const std::string& options) {
    return render("--mode raytrace --skip-existing --frames 0-3 -o s####.exr " + options).out;
  };
  EXPECT_NE(skipped("").find("4 frames were there already"), std::string::npos);
  EXPECT_EQ(skipped("--fps 12").find("were there already"), std::string::npos);
  EXPECT_EQ(skipped("--time 0.5 --fps 12").find("4 frames"), std::string::npos);
}

TEST_F(AnimatedTest, InfoTellsWhatMoves) {
  const CommandResult text = run("info" + scene("windmill.glb"));
  EXPECT_NE(text.out.find("animation 'wind', 4 s"), std::string::npos) << text.out;
  const nlohmann::json json = nlohmann::json::parse(run("info --json" + scene("windmill.glb")).out);
  EXPECT_EQ(json["animations"].size(), 1u);
  EXPECT_EQ(json["duration_s"], 4.0);
  EXPECT_TRUE(json["warnings"].empty());
  EXPECT_EQ(nlohmann::json::parse(run("info --json" + scene("cornell")).out)["duration_s"], 0.0);
}

TEST_F(AnimatedTest, MeasuresWhatMoves) {
  const CommandResult result = run("measure" + scene("windmill.glb") +
                                   "--size 80x60 --mode raytrace --frames 0-7 --quiet --stats-json m.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(AnimatedTest, ValuesThatCannotBeAreOneLine) {
  for (const std::string options : {"--time nan", "--time -1", "--time inf", "--time soon", "--fps 0",
                                    "--fps -3", "--fps 1.5", "--fps nan"}) {
    const CommandResult result = run("render" + scene("windmill.glb") + options + " -o x.exr");
    EXPECT_EQ(result.exit_code, 2) << options;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace pinocchio
