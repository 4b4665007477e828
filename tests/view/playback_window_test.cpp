// An animated scene on a display: play, pause, one frame on or back.
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

}  // namespace
}  // namespace pinocchio
