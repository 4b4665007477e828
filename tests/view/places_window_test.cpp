// Where panels are.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class PlacesTest : public WindowTest {
 protected:
  struct Box {
    int x = 0, y = 0, width = 0, height = 0;
  };
  // As the window has left them.
  [[nodiscard]] std::map<std::string, Box> boxes() const {
    const std::string layout =
        nlohmann::json::parse(text_of(folder_ / "config/pinocchio/window.json"))["layout"];
    std::map<std::string, Box> all;
    for (const char* panel : {"Drawing", "Camera", "Lights", "Materials"}) {
      const std::size_t begin = layout.find("[Window][" + std::string(panel) + "]");
      if (begin == std::string::npos) continue;
      Box& box = all[panel];
      std::sscanf(layout.c_str() + layout.find("Pos=", begin), "Pos=%d,%d", &box.x, &box.y);
      std::sscanf(layout.c_str() + layout.find("Size=", begin), "Size=%d,%d", &box.width, &box.height);
    }
    return all;
  }
};

TEST_F(PlacesTest, PanelsDoNotCoverEachOther) {
  open_as_is(scene("cornell"), "1200x740", "--spp 1");
  for (const char* panel : {"F3", "F5", "F6", "F7"}) {
    key(panel);
    settle();
  }
  expect_clean_close();
  const std::map<std::string, Box> all = boxes();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [a_name, a] : all)
    for (const auto& [b_name, b] : all)
      if (a_name < b_name) {
        EXPECT_FALSE(a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
                     b.y < a.y + a.height)
            << a_name << " and " << b_name;
      }
}

// Drawing has more rows with each channel, and stays whole and in the window.
TEST_F(PlacesTest, DrawingGrowsWithItsChannel) {
  open_as_is(scene("cornell"), "800x600", "--spp 1");
  key("F3");
  settle("drawing.png");
  const auto rows = [this] { return widgets_at(640, 30, 560).size(); };
  const std::size_t at_first = rows();
  for (int channel = 0; channel < 6; ++channel) {  // ids to depth, whose range can be set
    key("v");
    xdo(at(100, 500));
    settle("channel.png");
    EXPECT_GE(rows(), at_first) << channel;  // the last row, too
    EXPECT_EQ(different_in("300x20+470+8", "drawing.png", "channel.png", 40), 0) << channel;  // the title
  }
  expect_clean_close();
  const Box box = boxes().at("Drawing");
  EXPECT_LE(box.y + box.height, 580);
}

// At its edge, also one that was closed meanwhile.
TEST_F(PlacesTest, PanelsStayAtTheEdgesOfALargerWindow) {
  open_as_is(scene("cornell"), "800x600", "--spp 1");
  key("F3 F7");
  settle();
  key("F7");
  xdo("windowsize --sync " + window_ + " 1200 740");
  settle();
  key("F7");
  settle();
  expect_clean_close();
  const std::map<std::string, Box> all = boxes();
  EXPECT_EQ(all.at("Drawing").x + all.at("Drawing").width, 1200 - 8);
  const Box& materials = all.at("Materials");
  EXPECT_TRUE(materials.x == 8 || materials.x + materials.width == 1200 - 8) << materials.x;
}

}  // namespace
}  // namespace pinocchio
