// An animated scene on a display: play, pause, one frame on or back, and the slider of its time.
#include <cstdint>
#include <cstring>
#include <utility>

#include "tests/view/display.h"

namespace pinocchio {
namespace {

constexpr double kLength_s = 4.0;  // of the windmill's animation
constexpr double kFrame_s = 1.0 / 24.0;

class PlaybackWindowTest : public WindowTest {
 protected:
  // The time of the pose that is shown; -1: the command names none.
  [[nodiscard]] double time_s() {
    const std::string time = option(command_line(), "--time");
    return time.empty() ? -1.0 : std::stod(time);
  }
  // From the slider's right end to x.
  void pull(int x, int y) const {
    const auto to = [&](int column) {
      return "mousemove --window " + window_ + " " + std::to_string(column) + " " + std::to_string(y) +
             " sleep 0.1 ";
    };
    xdo(to(465) + "mousedown 1 sleep 0.1 " + to((465 + x) / 2) + to(x) + "mouseup 1");
  }
  // A pose is made after it was asked for.
  template <class Condition>
  [[nodiscard]] bool shows(Condition holds, double seconds = 60.0) {
    return becomes([&] { return holds(time_s()); }, seconds);
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

TEST_F(PlaybackWindowTest, TheSliderStopsAndMovesTheTime) {
  open_as_is(scene("windmill.glb"));
  key(kStill);
  EXPECT_EQ(time_s(), 0.0);
  // It lies above the status line, in the middle; how high that is depends on the font.
  constexpr int kLeft = 270, kMiddle = 350, kRight = 440;
  int y = 553;
  const auto found = [&] {
    pull(kMiddle, y);
    return shows([](double s) { return s > 0.0; }, 0.5);
  };
  for (int step = 1; !found() && step < 12; ++step) y = 553 + (step % 2 == 1 ? 5 : -5) * ((step + 1) / 2);
  double middle_s = time_s();
  ASSERT_GT(middle_s, 0.0) << "the slider is elsewhere";
  // The pull's last place is shown after those on its way.
  EXPECT_TRUE(becomes([&] {
    pause_ms(200);
    const double before_s = std::exchange(middle_s, time_s());
    return middle_s == before_s;
  }));
  pull(kRight, y);
  EXPECT_TRUE(shows([&](double s) { return s > middle_s && s <= kLength_s; }));
  pull(kLeft, y);
  EXPECT_TRUE(shows([&](double s) { return s > 0.0 && s < middle_s; }));
  key("space");
  const double begin_s = time_s();
  EXPECT_TRUE(shows([&](double s) { return s != begin_s; }));
  pull(kMiddle, y);
  // Where its handle is caught beside its middle, it stays as far off.
  EXPECT_TRUE(shows([&](double s) { return std::abs(s - middle_s) < 0.2; }));
  pause_ms(500);
  const double stopped_s = time_s();
  EXPECT_NEAR(stopped_s, middle_s, 0.2);
  pause_ms(500);
  EXPECT_EQ(time_s(), stopped_s);
  expect_clean_close();
}

// A warning of the file is above the bar, which works.
TEST_F(PlaybackWindowTest, AWarningDoesNotCoverTheBar) {
  const std::string text = text_of(scene("windmill.glb"));
  const auto number_at = [&text](std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, text.data() + at, sizeof(number));
    return number;
  };
  const std::uint32_t json_size = number_at(12);
  nlohmann::json json = nlohmann::json::parse(text.substr(20, json_size));
  json["extensionsUsed"].push_back("VENDOR_unknown");
  json["materials"][0]["extensions"]["VENDOR_unknown"] = {{"strength", 1}};
  std::ofstream(folder_ / "mill.bin", std::ios::binary) << text.substr(28 + json_size);
  json["buffers"][0]["uri"] = "mill.bin";
  std::ofstream(folder_ / "mill.gltf") << json;
  open_as_is("mill.gltf");
  ASSERT_NE(errors().find("VENDOR_unknown"), std::string::npos) << errors();
  EXPECT_EQ(time_s(), 0.0);
  constexpr int kMiddle = 350;
  EXPECT_TRUE(becomes([&] {
    for (int y = 545; y < 565; y += 4) {
      pull(kMiddle, y);
      if (shows([](double s) { return s > 0.0; }, 0.5)) return true;
    }
    return false;
  }));
  expect_clean_close("VENDOR_unknown");
}

}  // namespace
}  // namespace pinocchio
