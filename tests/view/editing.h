// A window with one panel open, of which the test changes what is shown.
#pragma once

#include "tests/view/display.h"

namespace pinocchio {

inline constexpr const char* kPicture = "380x400+410+40";  // right of the panels, above messages

class EditingTest : public WindowTest {
 protected:
  // One panel is at (8, 8); one sample a pixel, so that pictures stand still.
  void open_with(const std::string& panel, const std::string& scene_file, const std::string& options = "") {
    remember(panel, 8, 8);
    open_as_is(scene_file, "800x600", "--spp 1 " + options);
    settle("opened.png");
  }
  void drag_from(int x, int y, int by) const {
    xdo(at(x, y) + "sleep 0.1 mousedown 1 sleep 0.05 " + at(x + by / 2, y) + "sleep 0.05 " + at(x + by, y) +
        "sleep 0.05 mouseup 1 sleep 0.05 " + at(700, 500));  // off it: no tooltip
  }
  // Ctrl + click on a number, or a click on a text, and the keys of what replaces it.
  void type(int x, int y, const std::string& keys) const {
    click_with("ctrl", x, y);
    pause_ms(200);
    key("ctrl+a " + keys + " Return");
    xdo(at(700, 500));
  }
  [[nodiscard]] bool picture_becomes_other(const std::string& than) {
    return becomes([&] {
      grab("other.png");
      return different_in(kPicture, than, "other.png") > 1000;
    });
  }
  [[nodiscard]] bool picture_becomes(const std::string& before) {
    return becomes([&] {
      grab("same.png");
      return different_in(kPicture, before, "same.png") == 0;
    });
  }
  [[nodiscard]] nlohmann::json json_of(const std::string& file) const {
    return nlohmann::json::parse(text_of(folder_ / file), nullptr, false);
  }
  // The scene as it was edited, which P saves for its command.
  [[nodiscard]] nlohmann::json saved() {
    const std::string command = command_line();
    const std::string file = command.substr(std::string("pinocchio render ").size());
    return json_of(file.substr(0, file.find(' ')));
  }
  [[nodiscard]] std::array<double, 3> vector_option(const std::string& name) {
    std::array<double, 3> v{};
    std::sscanf(option(command_line(), name).c_str(), "%lf,%lf,%lf", &v[0], &v[1], &v[2]);
    return v;
  }
};

}  // namespace pinocchio
