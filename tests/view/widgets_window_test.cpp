// Widgets as a person meets them: pressed and looked at, and what the picture does then.
#include <array>

#include "core/compare/magma.h"
#include "tests/view/display.h"

namespace pinocchio {
namespace {

constexpr const char* kBesideWidgets =
    "420x400+370+60";  // right of the panel, below captions, above messages
constexpr int kPanelX = 8, kPanelY = 60;
constexpr int kWidgetX = kPanelX + 227;  // meets every row of widgets, between no two of them

class WidgetsTest : public WindowTest {
 protected:
  // The panel Drawing's rows of widgets, from above; the checkboxes are not among them.
  enum Row { kMode, kDesign, kPlan, kExchange, kDepth, kExposure, kToneCurve, kResolution, kShow, kCompare };

  // One sample a pixel, so that pictures stand still.
  void open_drawing(const std::string& scene_name, const std::string& options = "") {
    remember("Drawing", kPanelX, kPanelY);
    open_as_is(scene(scene_name), "800x600", "--spp 1" + options);
    still("opened.png");
  }
  // Off every widget: nothing is hovered, and no tooltip shown.
  std::string still(const std::string& file) {
    xdo(at(700, 500));
    settle(file);
    return file;
  }
  [[nodiscard]] std::vector<int> rows() const { return widgets_at(kWidgetX, kPanelY + 22, 560); }
  [[nodiscard]] std::array<double, 3> mean(const std::string& box, const std::string& file) const {
    return mean_of(crop(picture(file), box));
  }
  [[nodiscard]] std::vector<glm::u8vec3> pixels(const std::string& box, const std::string& file) const {
    const Picture cut = crop(picture(file), box);
    return {cut.pixels().begin(), cut.pixels().end()};
  }
  // The colour that most of a box has: a widget's, whatever text is on it.
  [[nodiscard]] glm::ivec3 color_of(const std::string& box, const std::string& file) const {
    const std::vector<glm::u8vec3> all = pixels(box, file);
    const auto count = [&all](const glm::u8vec3& c) { return std::ranges::count(all, c); };
    return all.empty() ? glm::ivec3(-1) : glm::ivec3(*std::ranges::max_element(all, {}, count));
  }
  void drag_field(int x, int y, int by) const {
    xdo(at(x, y) + "sleep 0.1 mousedown 1 sleep 0.05 " + at(x + by / 2, y) + "sleep 0.05 " + at(x + by, y) +
        "sleep 0.05 mouseup 1 sleep 0.05 ");
  }
  // A line of the list that "show" opens.
  void show(std::size_t line) const {
    const std::vector<int> all = rows();
    ASSERT_GT(all.size(), static_cast<std::size_t>(kShow));
    const int y = all[kShow];
    click(kWidgetX, y);
    pause_ms(300);
    xdo(at(kWidgetX + 80, y));
    std::vector<int> lines;
    ASSERT_TRUE(becomes([&] {
      lines = runs(brightness(kPanelX + 97, y + 12, 60, 560 - y), y + 12, 120, 6, 20);
      return lines.size() > line;
    }));
    click(kPanelX + 120, lines[line]);
  }
};

constexpr std::size_t kDepthLine = 6, kPositionLine = 7;

int apart(const glm::ivec3& a, const glm::ivec3& b) {
  const glm::ivec3 off = glm::abs(a - b);
  return std::max({off.x, off.y, off.z});
}

// Depth: what is white comes nearer, all gets brighter; what is black goes away, darker; and as it was.
TEST_F(WidgetsTest, TheRangeOfDepthIsDragged) {
  open_drawing("cornell");
  ASSERT_NO_FATAL_FAILURE(show(kDepthLine));
  still("automatic.png");
  EXPECT_GT(different_in(kBesideWidgets, "opened.png", "automatic.png"), 100000);
  const std::vector<int> before = rows();
  ASSERT_EQ(before.size(), kCompare + 1u);
  const int checkbox_y = (before[kShow] + before[kCompare]) / 2;
  click(kPanelX + 18, checkbox_y);
  still("by-hand.png");
  EXPECT_EQ(different_in(kBesideWidgets, "automatic.png", "by-hand.png"),
            0);  // it begins with what was shown
  const std::vector<int> after = rows();
  ASSERT_EQ(after.size(), before.size() + 2);
  drag_field(kWidgetX, after[kShow + 2], -100);  // white at
  const double as_found = mean(kBesideWidgets, "by-hand.png")[0],
               brighter = mean(kBesideWidgets, still("white.png"))[0];
  EXPECT_GT(brighter, as_found + 0.02);
  drag_field(kWidgetX, after[kShow + 1], 100);  // black at
  EXPECT_LT(mean(kBesideWidgets, still("black.png"))[0], brighter - 0.02);
  click(kPanelX + 18, checkbox_y);
  still("again.png");
  EXPECT_EQ(different_in(kBesideWidgets, "automatic.png", "again.png"), 0);
  EXPECT_EQ(rows().size(), before.size());
  expect_clean_close();
}

// Position: each axis has its own, and only its colour changes.
TEST_F(WidgetsTest, TheRangeOfPositionIsDraggedAxisByAxis) {
  open_drawing("cornell");
  ASSERT_NO_FATAL_FAILURE(show(kPositionLine));
  still("automatic.png");
  const std::vector<int> before = rows();
  ASSERT_EQ(before.size(), kCompare + 1u);
  click(kPanelX + 18, (before[kShow] + before[kCompare]) / 2);
  still("by-hand.png");
  const std::vector<int> after = rows();
  ASSERT_EQ(after.size(), before.size() + 2);
  std::array<double, 3> last = mean(kBesideWidgets, "by-hand.png");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drag_field(kPanelX + 130 + 84 * static_cast<int>(axis), after[kShow + 2], -80);
    const std::array<double, 3> now = mean(kBesideWidgets, still("dragged.png"));
    for (std::size_t c = 0; c < 3; ++c) {
      if (c == axis)
        EXPECT_GT(now[c], last[c] + 0.01) << axis;
      else
        EXPECT_NEAR(now[c], last[c], 1e-4) << axis << ", colour " << c;
    }
    last = now;
  }
  expect_clean_close();
}

TEST_F(WidgetsTest, TheToneCurveIsChosen) {
  open_drawing("cornell");
  const std::vector<int> all = rows();
  ASSERT_EQ(all.size(), kCompare + 1u);
  const std::array<int, 4> xs{kPanelX + 99, kPanelX + 166, kPanelX + 234,
                              kPanelX + 301};  // clip, reinhard, aces, neutral
  click(xs[1], all[kToneCurve]);
  still("reinhard.png");
  EXPECT_LT(mean(kBesideWidgets, "reinhard.png")[0],
            mean(kBesideWidgets, "opened.png")[0] - 0.05);  // all is darker
  EXPECT_EQ(option(command_line(), "--tone-map"), "reinhard");
  click(xs[2], all[kToneCurve]);
  still("aces.png");
  EXPECT_GT(different_in(kBesideWidgets, "reinhard.png", "aces.png"), 100000);
  EXPECT_GT(different_in(kBesideWidgets, "opened.png", "aces.png"), 100000);
  EXPECT_EQ(option(command_line(), "--tone-map"), "aces");
  click(xs[3], all[kToneCurve]);
  EXPECT_TRUE(becomes([this] { return option(command_line(), "--tone-map") == "neutral"; }));
  click(xs[0], all[kToneCurve]);
  still("clip.png");
  EXPECT_EQ(different_in(kBesideWidgets, "opened.png", "clip.png"), 0);
  EXPECT_EQ(option(command_line(), "--tone-map"), "");
  expect_clean_close();
}

// It is there while the difference is shown, all its colours in their order, and not with the reference.
TEST_F(WidgetsTest, TheDifferenceHasItsColourScale) {
  open_drawing("cornell");
  key("bracketleft bracketleft bracketleft bracketleft bracketleft bracketleft");  // the reference is slow
  still("opened.png");
  const std::vector<int> all = rows();
  ASSERT_EQ(all.size(), kCompare + 1u);
  constexpr int kSteps = 64, kWidth = 3;  // of the scale
  Image<float> errors({kSteps, 1});
  for (int i = 0; i < kSteps; ++i) errors.at(i, 0) = static_cast<float>(i) / (kSteps - 1);
  const Image<glm::u8vec3> colors = magma(errors);
  const auto has_scale = [&](const std::string& file) {
    for (int y = 8; y < 60; y += 6) {
      const std::vector<glm::u8vec3> row = pixels("800x1+0+" + std::to_string(y), file);
      for (int x = 0; x + kSteps * kWidth <= 800; ++x) {
        int step = 0;
        while (step < kSteps && apart(glm::ivec3(row[static_cast<std::size_t>(x + kWidth * step + 1)]),
                                      glm::ivec3(colors.at(step, 0))) <= 2)
          ++step;
        if (step == kSteps) return true;
      }
    }
    return false;
  };
  const std::array<int, 3> xs{kPanelX + 130, kPanelX + 215, kPanelX + 300};  // off, reference, difference
  EXPECT_FALSE(has_scale("opened.png"));
  click(xs[1], all[kCompare]);
  EXPECT_FALSE(has_scale(still("reference.png")));
  click(xs[2], all[kCompare]);
  EXPECT_TRUE(has_scale(still("difference.png")));
  click(xs[0], all[kCompare]);
  EXPECT_FALSE(has_scale(still("off.png")));
  EXPECT_EQ(different_in(kBesideWidgets, "opened.png", "off.png"), 0);
  expect_clean_close();
}

// A warning and an error: one goes by a click on its x, the other stays; then that one.
TEST_F(WidgetsTest, AClickOnTheXDismissesAMessage) {
  std::ofstream(folder_ / "broken.mtl") << "newmtl m\nKd oops\n";
  std::ofstream(folder_ / "broken.obj")
      << "mtllib broken.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder_ / "damaged.obj") << "v 0 0 0\nf 1 2 7\n";
  open_as_is("broken.obj", "800x600", "--spp 1 --light 1,2,3");
  const auto box = "800x200+0+370";
  const auto message_rows = [this] { return widgets_at(28, 370, 576); };
  pause_ms(7000);  // what P said is gone by itself
  still("warning.png");
  ASSERT_EQ(message_rows().size(), 1u) << errors();
  key("Right");
  ASSERT_TRUE(becomes([this] { return errors().find("damaged.obj") != std::string::npos; })) << errors();
  still("both.png");
  const std::vector<int> both = message_rows();
  ASSERT_EQ(both.size(), 2u);
  EXPECT_GT(different_in(box, "warning.png", "both.png"), 1000);
  click(28, both[1]);
  still("warning-again.png");
  EXPECT_EQ(different_in(box, "warning.png", "warning-again.png"), 0);
  click(28, message_rows().at(0));
  still("none.png");
  EXPECT_GT(different_in(box, "warning.png", "none.png"), 1000);
  EXPECT_EQ(message_rows().size(), 0u);
  key("Escape");
  EXPECT_EQ(program_->wait(), 0);
}

// A button and a line of a list: chosen, under the pointer, both, and neither. Greys are neither chosen.
TEST_F(WidgetsTest, ChosenAndHoveredLookDifferent) {
  open_drawing("cornell");
  const std::vector<int> all = rows();
  ASSERT_EQ(all.size(), kCompare + 1u);
  const auto button = [&](int x, const std::string& file) {
    return color_of("20x12+" + std::to_string(x) + "+" + std::to_string(all[kMode] - 6), file);
  };
  const int chosen_x = kPanelX + 95, plain_x = kPanelX + 285;            // hybrid, auto
  const auto expect_apart = [](const std::vector<glm::ivec3>& colors) {  // plain, hovered, chosen, both
    const auto is_grey = [](const glm::ivec3& c) { return std::abs(c.r - c.b) < 20; };
    EXPECT_TRUE(is_grey(colors[0]) && is_grey(colors[1]));
    EXPECT_GT(apart(colors[0], colors[1]), 20);
    EXPECT_FALSE(is_grey(colors[2]) || is_grey(colors[3]));
  };
  const glm::ivec3 plain = button(plain_x, "opened.png"), chosen = button(chosen_x, "opened.png");
  xdo(at(plain_x + 10, all[kMode]));
  settle("hovered.png");
  const glm::ivec3 hovered = button(plain_x, "hovered.png");
  xdo(at(chosen_x + 10, all[kMode]));
  settle("both.png");
  expect_apart({plain, hovered, chosen, button(chosen_x, "both.png")});
  // Letters are dark on the accent's colour, and light elsewhere.
  const auto letters = [&](int x, auto is_letter) {
    return std::ranges::count_if(
        pixels("60x12+" + std::to_string(x) + "+" + std::to_string(all[kMode] - 6), "opened.png"), is_letter);
  };
  EXPECT_GT(letters(chosen_x, [](const glm::u8vec3& c) { return c.r < 90 && c.g < 90; }), 20);
  EXPECT_EQ(letters(chosen_x, [](const glm::u8vec3& c) { return c.b > 200; }), 0);
  EXPECT_GT(letters(plain_x, [](const glm::u8vec3& c) { return c.b > 150; }), 20);
  // The list: its first line is chosen.
  click(kWidgetX, all[kShow]);
  xdo(at(kWidgetX + 80, all[kShow]));
  settle("list.png");
  const int from = all[kShow] + 12;
  const auto line = [&](int y, const std::string& file) {
    return color_of("20x8+" + std::to_string(kPanelX + 200) + "+" + std::to_string(y - 4), file);
  };
  const int first = from + 12, third = from + 12 + 36;
  xdo(at(kPanelX + 180, third));
  settle("hovered.png");
  xdo(at(kPanelX + 180, first));
  settle("both.png");
  expect_apart({line(third, "list.png"), line(third, "hovered.png"), line(first, "list.png"),
                line(first, "both.png")});
  expect_clean_close();
}

// Wherever its grip is, the value is read beside it: white letters and nothing of the grip; none on the
// slider.
TEST_F(WidgetsTest, SlidersDoNotCoverTheirText) {
  open_drawing("cornell", " --mode raster");
  const std::vector<int> all = rows();
  ASSERT_EQ(all.size(), kCompare + 1u);
  const int left = kPanelX + 91, right = kPanelX + 240;  // the slider
  const auto count = [&](int x, int width, int y, const std::string& file, auto what) {
    return std::ranges::count_if(
        pixels(std::to_string(width) + "x16+" + std::to_string(x) + "+" + std::to_string(y - 8), file), what);
  };
  const auto is_text = [](const glm::u8vec3& c) { return c.r > 180 && c.g > 180 && c.b > 180; };
  const auto is_grip = [](const glm::u8vec3& c) { return c.r > c.b + 60; };
  for (const int row : {kDepth, kExposure}) {
    const int y = all[static_cast<std::size_t>(row)];
    for (const int x : {left + 4, (left + right) / 2, right - 4}) {
      click(x, y);
      const std::string file = still("slider.png");
      EXPECT_GT(count(left, right - left, y, file, is_grip), 50) << row << " " << x;
      EXPECT_EQ(count(left, right - left, y, file, is_text), 0) << row << " " << x;
      EXPECT_GT(count(right + 5, 95, y, file, is_text), 40) << row << " " << x;
      EXPECT_EQ(count(right + 5, 95, y, file, is_grip), 0) << row << " " << x;
    }
  }
  expect_clean_close();
}

// What is not drawn is not ticked.
TEST_F(WidgetsTest, RasterTicksNeitherShadowsNorReflections) {
  open_drawing("cornell");
  const std::vector<int> all = rows();
  ASSERT_EQ(all.size(), kCompare + 1u);
  const auto amber = [&](const std::string& file) {
    const int y = (all[kExchange] + all[kDepth]) / 2;
    return std::ranges::count_if(pixels("200x20+12+" + std::to_string(y - 10), file),
                                 [](const glm::u8vec3& c) { return c.r > c.b + 60; });
  };
  EXPECT_GT(amber("opened.png"), 40);
  key("m m");  // raytrace, raster
  still("raster.png");
  EXPECT_EQ(amber("raster.png"), 0);
  key("m m");  // auto, hybrid
  still("hybrid.png");
  EXPECT_GT(amber("hybrid.png"), 40);
  expect_clean_close();
}

// The status line says "done" only once the reference is complete, too.
TEST_F(WidgetsTest, DoneIsSaidWhenTheReferenceIsComplete) {
  open_drawing("cornell");
  const std::string word = "34x16+8+580";
  key("b");
  EXPECT_TRUE(becomes([&] {
    grab("comparing.png");
    return different_in(word, "opened.png", "comparing.png") > 20;
  }));
  pause_ms(1000);
  grab("comparing.png");
  EXPECT_GT(different_in(word, "opened.png", "comparing.png"), 20);
  key("b b");  // off
  EXPECT_TRUE(becomes([&] {
    grab("done.png");
    return different_in(word, "opened.png", "done.png") == 0;
  }));
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
