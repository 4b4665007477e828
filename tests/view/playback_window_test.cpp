// An animated scene on a display: play, pause, one frame on or back, and the slider of its time.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

constexpr const char* kStill = "n";  // key: samples are not gathered, so that pictures stand still
constexpr double kLength_s = 4.0;    // of the windmill's animation
constexpr double kFrame_s = 1.0 / 24.0;

class PlaybackWindowTest : public WindowTest {
 protected:
  // Of the pose that is shown; -1: the command names none.
  [[nodiscard]] double time_s() {
    const std::string time = option(command_line(), "--time");
    return time.empty() ? -1.0 : std::stod(time);
  }
  void click(int x, int y) const {
    xdo("mousemove --window " + window_ + " " + std::to_string(x) + " " + std::to_string(y) +
        " sleep 0.2 mousedown 1 sleep 0.2 mouseup 1 sleep 0.2");
  }
};

TEST_F(PlaybackWindowTest, PlaysPausesAndGoesOnByFrames) {
  open(scene("windmill.glb"));
  key(kStill);
  const double begin_s = time_s();
  EXPECT_EQ(begin_s, 0.0);
  settle();
  grab("begin.png");
  key("space");
  EXPECT_TRUE(becomes([&] { return time_s() > begin_s; }));
  key("space");
  pause_ms(500);  // the pose that was being made
  const double paused_s = time_s();
  EXPECT_LE(paused_s, kLength_s);
  pause_ms(500);
  EXPECT_EQ(time_s(), paused_s);
  settle();
  grab("paused.png");
  EXPECT_GT(different("begin.png", "paused.png"), 100);

  key("ctrl+Right");
  pause_ms(500);
  const double next_s = time_s();
  EXPECT_NEAR(next_s, (std::round(paused_s / kFrame_s) + 1.0) * kFrame_s, 1e-6);
  key("ctrl+Left");
  pause_ms(500);
  EXPECT_NEAR(time_s(), next_s - kFrame_s, 1e-6);
  expect_clean_close();
}

TEST_F(PlaybackWindowTest, TheSliderMovesTheTimeAndTheCommandDrawsIt) {
  open_as_is(scene("windmill.glb"));
  key(kStill);
  key("space");
  ASSERT_TRUE(becomes([&] { return time_s() > 0.0; }));
  // It lies above the status line, in the middle; how high that is depends on the font.
  int y = 585;
  while (y > 500 && (click(440, y), pause_ms(300), std::abs(time_s() - time_s()) > 0.0)) y -= 6;
  ASSERT_GT(y, 500) << "no slider stopped the animation";
  const double late_s = time_s();
  EXPECT_GT(late_s, 0.5 * kLength_s);
  click(300, y);
  pause_ms(500);
  const double early_s = time_s();
  EXPECT_LT(early_s, 0.5 * kLength_s);
  EXPECT_GT(early_s, 0.0);

  // Without the overlay it is the picture that the command draws.
  key("h");
  settle();
  const std::string command = command_line();
  grab("display.png");
  std::string headless = "'" PINOCCHIO_PROGRAM "'" + command.substr(std::string("pinocchio").size());
  EXPECT_EQ(run_command("cd '" + folder_.string() + "' && " + headless, folder_).exit_code, 0) << headless;
  EXPECT_EQ(different("display.png", option(command, "--preview")), 0) << command;
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
