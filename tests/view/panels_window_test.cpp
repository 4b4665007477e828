// What is clicked and dragged in panels: each is put where the test looks for it, as if an earlier run had
// left it there; its widgets are found by their looks, wherever the font has put them.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class PanelsTest : public WindowTest {
 protected:
  // With one panel at (8, y); one sample a pixel, so that pictures stand still.
  void open_with(const std::string& panel, int y, const std::string& scene, const std::string& options = "") {
    remember(panel, 8, y);
    open_as_is(scene, "800x600", "--spp 1" + options);
  }
  void drag_from(int x, int y, int by) const {
    xdo(at(x, y) + "sleep 0.1 mousedown 1 sleep 0.05 " + at(x + by / 2, y) + "sleep 0.05 " + at(x + by, y) +
        "sleep 0.05 mouseup 1 sleep 0.05 " + at(700, 20));  // off it: no tooltip
  }
  // The scene as it was edited, which P saves for its command.
  [[nodiscard]] nlohmann::json saved() {
    const std::string command = command_line();
    const std::string file = command.substr(std::string("pinocchio render ").size());
    return nlohmann::json::parse(text_of(folder_ / file.substr(0, file.find(' '))));
  }
};

constexpr const char* kBesidePanels = "440x500+350+10";  // right of the panels, above messages

// Each changes what is drawn, is in the saved scene, and is taken back.
TEST_F(PanelsTest, AMaterialIsPickedAndChanged) {
  open_with("Materials", 8, scene("cornell"));
  const auto phong = [](const nlohmann::json& gltf, const std::string& name) {
    for (const nlohmann::json& material : gltf["materials"])
      if (material["name"] == name) return material["extras"]["pinocchio"]["phong"];
    return nlohmann::json();
  };
  settle();
  const std::vector<int> rows = widgets_at(8 + 112, 8 + 140, 420);
  ASSERT_EQ(rows.size(), 5u);  // diffuse, specular, shininess, mirror, index
  nlohmann::json before;
  const auto changes = [&](const char* material, int row, const char* what) {
    grab("before.png");
    drag_from(8 + 130, rows[static_cast<std::size_t>(row)], 60);
    EXPECT_TRUE(becomes(
        [&] {
          grab("after.png");
          return different_in(kBesidePanels, "before.png", "after.png") > 100;
        },
        20.0))
        << what;
    const nlohmann::json now = phong(saved(), material);
    ASSERT_TRUE(now.contains(what)) << now;
    EXPECT_TRUE(!before.contains(what) || now[what] != before[what]) << now;
    before = now;
    settle();
  };
  const auto pick = [&](int x, int y) {
    click_with("ctrl", x, y);
    settle();
    before = nlohmann::json();
  };
  pick(480, 200);  // the back wall
  grab("first.png");
  changes("white", 0, "kd");
  changes("white", 1, "ks");
  changes("white", 2, "shininess");
  changes("white", 3, "reflect");
  pick(495, 440);  // the ball
  changes("glass", 4, "ior");
  key("ctrl+z ctrl+z ctrl+z ctrl+z ctrl+z");
  EXPECT_TRUE(becomes(
      [&] {
        grab("undone.png");
        return different_in(kBesidePanels, "first.png", "undone.png") == 0;
      },
      20.0));
  key("ctrl+y");
  EXPECT_TRUE(becomes(
      [&] {
        grab("redone.png");
        return different_in(kBesidePanels, "first.png", "redone.png") > 100;
      },
      20.0));
  key("ctrl+s");
  expect_clean_close();
}

// Each edit draws one frame, and that has it: in a recording there is no other.
TEST_F(PanelsTest, AMaterialIsSeenInTheNextFrame) {
  open_with("Materials", 8, scene("cornell"), " --mode hybrid");
  settle();
  const std::vector<int> rows = widgets_at(8 + 112, 8 + 140, 420);
  ASSERT_EQ(rows.size(), 5u);
  click_with("ctrl", 480, 200);  // the back wall
  settle();
  drag_from(8 + 130, rows[0], 60);
  settle();
  pause_ms(500);  // a step of its own
  key("k");
  const auto file = [](int number) { return "cornell-001-000" + std::to_string(number) + ".png"; };
  const auto exists = [&](int number) { return std::filesystem::exists(folder_ / file(number)); };
  for (int number = 1; number <= 3; ++number) {
    key(number == 2 ? "ctrl+y" : "ctrl+z");
    EXPECT_TRUE(becomes([&] { return exists(number); }, 20.0)) << number;
    settle();
    EXPECT_FALSE(exists(number + 1));
  }
  key("k");
  EXPECT_GT(different_in(kBesidePanels, file(1), file(2)), 100);
  EXPECT_EQ(different(file(1), file(3)), 0);
  expect_clean_close();
}

// The camera is on the axis, before its target.
TEST_F(PanelsTest, ButtonsLookAlongTheAxes) {
  open_with("Camera", 8, scene("cornell"));
  const auto vector_of = [](const std::string& text) {
    std::array<double, 3> v{};
    std::sscanf(text.c_str(), "%lf,%lf,%lf", &v[0], &v[1], &v[2]);
    return v;
  };
  settle();
  const std::vector<int> rows = widgets_at(150, 30, 280);  // eye, target, two sliders, list, "Top", "Bottom"
  ASSERT_GE(rows.size(), 7u);
  const std::array<int, 6> xs{42, 92, 136, 39, 85, 140},
      axes{2, 0, 1, 2, 0, 1};  // front, right, top; back ...
  for (std::size_t i = 0; i < xs.size(); ++i) {
    click(xs[i], rows[i < 3 ? 5 : 6]);
    EXPECT_TRUE(becomes(
        [&] {
          const std::string command = command_line();
          const auto eye = vector_of(option(command, "--eye")),
                     target = vector_of(option(command, "--target"));
          for (int axis = 0; axis < 3; ++axis) {
            const double off = eye[static_cast<std::size_t>(axis)] - target[static_cast<std::size_t>(axis)];
            const double along = i < 3 ? off : -off;
            if (axis == axes[i] ? along < 1.0 : std::abs(off) > 0.02) return false;
          }
          return true;
        },
        20.0))
        << command_line();
  }
  expect_clean_close();
}

// Paused it stays while frames are drawn, and is enlarged and dragged; then it follows again.
TEST_F(PanelsTest, TheTimelineIsPausedAndZoomed) {
  open_with("Timeline", 400, scene("cornell"));
  constexpr int kAlike = 5;                   // percent: the panel lets a little of the picture through
  const std::string chart = "740x94+18+440";  // above the message about the printed command
  const auto grabbed = [&](const std::string& file) {
    xdo(at(700, 20));
    settle(file);
  };
  const auto turn = [this] { drag(1, 40, 0); };
  turn();
  grabbed("one.png");
  turn();
  grabbed("two.png");
  EXPECT_GT(different_in(chart, "one.png", "two.png", kAlike), 300);  // it follows
  const std::vector<int> rows = widgets_at(8 + 14, 400 + 22, 450);
  ASSERT_EQ(rows.size(), 1u);
  click(40, rows[0]);  // Pause
  grabbed("paused.png");
  turn();
  grabbed("later.png");
  EXPECT_LT(different_in(chart, "paused.png", "later.png", kAlike), 50);
  xdo(at(400, 490) + "sleep 0.1 click 4 sleep 0.1 click 4");
  grabbed("near.png");
  EXPECT_GT(different_in(chart, "later.png", "near.png", kAlike), 300);
  drag_from(300, 490, 300);  // what was before
  grabbed("before.png");
  EXPECT_GT(different_in(chart, "near.png", "before.png", kAlike), 300);
  drag_from(600, 490, -300);
  grabbed("again.png");
  EXPECT_LT(different_in(chart, "near.png", "again.png", kAlike), 50);
  click(40, rows[0]);  // Continue
  turn();
  grabbed("on.png");
  turn();
  grabbed("following.png");
  EXPECT_GT(different_in(chart, "on.png", "following.png", kAlike), 300);
  expect_clean_close();
}

// A light is moved by its number, and put back.
TEST_F(PanelsTest, ALightIsMovedAndPutBack) {
  open_with("Lights", 8, scene("cornell"), " --mode raster");
  settle("before.png");
  const std::vector<int> rows = widgets_at(8 + 112, 8 + 22, 300);
  ASSERT_GE(rows.size(), 3u);        // position, colour, intensity
  drag_from(8 + 140, rows[2], -60);  // darker
  EXPECT_TRUE(becomes(
      [&] {
        grab("after.png");
        return different_in(kBesidePanels, "before.png", "after.png") > 10000;
      },
      20.0));
  pause_ms(500);  // a step of its own
  key("ctrl+z");
  EXPECT_TRUE(becomes(
      [&] {
        grab("undone.png");
        return different_in(kBesidePanels, "before.png", "undone.png") == 0;
      },
      20.0));
  expect_clean_close();
}

// A panel in front keeps what is below it quiet.
TEST_F(PanelsTest, TooltipsDoNotLeakThroughPanels) {
  std::filesystem::create_directories(folder_ / "config/pinocchio");
  const std::string layout =
      "[Window][Timeline]\nPos=8,400\nSize=100,100\nCollapsed=0\n"
      "[Window][Camera]\nPos=8,330\nSize=100,100\nCollapsed=0\n";
  std::ofstream(folder_ / "config/pinocchio/window.json")
      << nlohmann::json{{"open", {"Timeline", "Camera"}}, {"layout", layout}};
  open_as_is(scene("cornell"), "800x600", "--spp 1");
  for (int i = 0; i < 2; ++i) drag(1, 40, 0);
  click(150, 340);                           // the camera's title: it comes to the front
  const std::string box = "150x90+330+440";  // right of that panel, on the timeline
  xdo(at(700, 20));
  settle("quiet.png");
  // Wherever a stage is below.
  for (int y = 464; y < 526; y += 10) {  // beside the camera's buttons
    xdo(at(296, y));
    settle("hovered.png");
    EXPECT_EQ(different_in(box, "quiet.png", "hovered.png"), 0) << y;
  }
  click(296, 338);  // the camera's panel is closed
  xdo(at(700, 20));
  settle("quiet.png");
  // Where a stage lies depends on the machine's speed: the first that is met.
  const std::string timeline = "790x180+8+400";
  bool told = false;
  for (int x = 84; x < 750 && !told; x += 12) {
    xdo(at(x, 464));  // the row of the GPU
    told = becomes(
        [&] {
          grab("hovered.png");
          return different_in(timeline, "quiet.png", "hovered.png") > 500;
        },
        1.0);
  }
  EXPECT_TRUE(told);
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
