// A display of the test's own (Xvfb) with a window manager, and the program in a window on it, driven by real
// key and mouse events.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/own_file.h"
#include "tests/view/picture.h"
#include "tests/view/process.h"
#include "tests/view/screen.h"

namespace pinocchio {

inline constexpr const char* kStill = "n";  // key: samples are not gathered, so that pictures stand still

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {"Xvfb", "openbox", "xdotool"})
      if (std::system((std::string("command -v ") + tool + " >/dev/null").c_str()) != 0)
        GTEST_SKIP() << tool << " is not installed (scripts/packages-test.txt)";
    folder_ = own_folder() / "run";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    start_display();
  }
  void TearDown() override {
    program_.reset();
    manager_.reset();
    screen_.reset();
    server_.reset();
    std::filesystem::remove_all(folder_);
  }

  // A program with a window; what windows remember is the test's own.
  void start(const std::vector<std::string>& command, const std::vector<std::string>& environment = {}) {
    std::vector<std::string> all{"DISPLAY=" + display_, "PINOCCHIO_GL_DEBUG=1", "LP_NUM_THREADS=2",
                                 "XDG_CONFIG_HOME=" + (folder_ / "config").string()};
    all.insert(all.end(), environment.begin(), environment.end());
    program_.emplace(command, folder_, all, folder_ / "out.txt", folder_ / "err.txt");
    ASSERT_TRUE(becomes([this] { return !xdo("search --onlyvisible --name Pinocchio").empty(); }))
        << errors();
    window_ = xdo("search --onlyvisible --name Pinocchio");
    window_ = window_.substr(0, window_.find('\n'));
  }

  // The same with the scene on it as a person meets it: nothing hidden.
  void open_as_is(const std::string& scene, const std::string& size = "800x600",
                  const std::string& options = "", const std::vector<std::string>& environment = {}) {
    std::vector<std::string> command{PINOCCHIO_PROGRAM, "view", scene, "--size", size};
    for (const std::string& word : words_of(options)) command.push_back(word);
    start(command, environment);
    wait_for_keys();
  }

  // The program in a window of 320x240 with the scene on it and the overlay hidden.
  void open(const std::string& scene, const std::string& options = "",
            const std::vector<std::string>& environment = {}) {
    std::vector<std::string> command{PINOCCHIO_PROGRAM, "view", scene, "--size", "320x240"};
    for (const std::string& word : words_of(options)) command.push_back(word);
    start(command, environment);
    wait_for_keys();
    key("h");
  }

  // As if an earlier run had left this panel open, with its corner there.
  void remember(const std::string& panel, int x, int y) const {
    const std::string layout = "[Window][" + panel + "]\nPos=" + std::to_string(x) + "," + std::to_string(y) +
                               "\nSize=100,100\nCollapsed=0\n";
    std::filesystem::create_directories(folder_ / "config/pinocchio");
    std::ofstream(folder_ / "config/pinocchio/window.json")
        << nlohmann::json{{"open", {panel}}, {"layout", layout}};
  }

  // Keys reach it once the window manager has framed it and given it the focus; P says nothing while a scene
  // is read, and is pressed again.
  void wait_for_keys() {
    const xcb_window_t window = id();
    ASSERT_TRUE(becomes([&] { return screen_->active_window() == window; })) << errors();
    const auto printed = [this] { return lines_of("pinocchio render"); };
    long presses = 0;
    ASSERT_TRUE(becomes([&] {
      xdo("windowfocus --sync " + window_);
      key("p");
      ++presses;
      return becomes([&] { return printed() > 0; }, 0.4);
    })) << errors();
    (void)becomes([&] { return printed() == presses; }, 0.4);  // none of them is taken for a later one's
  }

  static std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
      end = std::min(text.find(' ', at), text.size());
      words.push_back(text.substr(at, end - at));
    }
    return words;
  }

  std::string xdo(const std::string& arguments) const {
    return run_command("DISPLAY=" + display_ + " xdotool " + arguments, folder_).out;
  }
  void key(const std::string& names) const { xdo("key --delay 40 " + names); }
  // The start of what the pointer does there, in pixels of the window.
  [[nodiscard]] std::string at(int x, int y) const {
    return "mousemove --window " + window_ + " " + std::to_string(x) + " " + std::to_string(y) + " ";
  }
  // Not at once: window managers hold the pointer while they see to the focus.
  void click(int x, int y, int button = 1) const {
    xdo(at(x, y) + "sleep 0.1 mousedown " + std::to_string(button) + " sleep 0.05 mouseup " +
        std::to_string(button));
  }
  // modifiers: "ctrl", "ctrl keydown shift".
  void click_with(const std::string& modifiers, int x, int y) const {
    xdo(at(x, y) + "keydown " + modifiers + " sleep 0.05 click 1 sleep 0.05 keyup ctrl keyup shift");
  }
  void drag(int button, int x, int y, const std::string& modifier = "") const {
    const std::string at = "mousemove --window " + window_ + " ";
    const std::string down = modifier.empty() ? "" : "keydown " + modifier + " ";
    const std::string up = modifier.empty() ? "" : " keyup " + modifier;
    const std::string b = std::to_string(button);
    xdo(at + "160 120 " + down + "mousedown " + b + " sleep 0.1 " + at + std::to_string(160 + x / 2) + " " +
        std::to_string(120 + y / 2) + " sleep 0.1 " + at + std::to_string(160 + x) + " " +
        std::to_string(120 + y) + " sleep 0.1 mouseup " + b + up);
  }

  // What P prints: all of the view in one line.
  std::string command_line() {
    const std::string before = text_of(folder_ / "out.txt");
    std::string line;
    key("p");
    (void)becomes([&] {
      const std::string now = text_of(folder_ / "out.txt");
      const std::size_t at = now.find("pinocchio render", before.size());
      if (at == std::string::npos || now.find('\n', at) == std::string::npos) return false;
      line = now.substr(at, now.find('\n', at) - at);
      return true;
    });
    return line;
  }
  static std::string option(const std::string& line, const std::string& name) {
    const std::size_t at = line.find(" " + name + " ");
    if (at == std::string::npos) return {};
    const std::size_t begin = at + name.size() + 2;
    return line.substr(begin, line.find(' ', begin) - begin);
  }

  [[nodiscard]] xcb_window_t id() const { return static_cast<xcb_window_t>(std::stoul(window_)); }
  // The window's inside, as the display has it; kept by a name.
  void grab(const std::string& name) { pictures_[name] = screen_->picture_of(id()); }
  // One that was grabbed, or a PNG file that the program wrote.
  [[nodiscard]] Picture picture(const std::string& name) const {
    const auto grabbed = pictures_.find(name);
    return grabbed != pictures_.end() ? grabbed->second : picture_of_file(folder_ / name);
  }
  // Pixels that differ; -1 where the pictures cannot be compared.
  [[nodiscard]] long long different(const std::string& a, const std::string& b) const {
    return different_pixels(picture(a), picture(b));
  }
  // The same of a box "WIDTHxHEIGHT+X+Y"; channels closer than `percent` count as equal.
  [[nodiscard]] long long different_in(const std::string& box, const std::string& a, const std::string& b,
                                       int percent = 0) const {
    return different_pixels(crop(picture(a), box), crop(picture(b), box), percent);
  }
  // Seconds of processors that the program uses in a second, over `seconds`.
  [[nodiscard]] double load(double seconds) const {
    const double before_s = program_->cpu_s();
    pause_ms(static_cast<int>(1e3 * seconds));
    return (program_->cpu_s() - before_s) / seconds;
  }
  // How bright the window is, 0 to 255: the greatest of each of a box's rows.
  [[nodiscard]] std::vector<int> brightness(int x, int y, int width, int height) const {
    return brightest_of_rows(
        crop(screen_->picture_of(id()), std::to_string(width) + "x" + std::to_string(height) + "+" +
                                            std::to_string(x) + "+" + std::to_string(y)));
  }
  // Middles of the runs of rows that are brighter, of those that are so high.
  [[nodiscard]] static std::vector<int> runs(const std::vector<int>& rows, int first_y, int brighter,
                                             int thinnest, int thickest) {
    std::vector<int> middles;
    int length = 0;
    for (std::size_t i = 0; i <= rows.size(); ++i) {
      if (i < rows.size() && rows[i] > brighter) {
        ++length;
        continue;
      }
      if (length >= thinnest && length <= thickest)
        middles.push_back(first_y + static_cast<int>(i) - length / 2);
      length = 0;
    }
    return middles;
  }
  // Heights of the fields, sliders and buttons of a panel that a line down at `x` meets.
  [[nodiscard]] std::vector<int> widgets_at(int x, int from_y, int to_y) const {
    constexpr int kPanel = 27;  // or darker, whatever is under it
    return runs(brightness(x, from_y, 1, to_y - from_y), from_y, kPanel, 10, 30);
  }
  // Heights of a panel's lines of text, below its title; x: in its left margin.
  [[nodiscard]] std::vector<int> lines_of_panel(int x, int from_y) const {
    constexpr int kPanel = 27, kText = 120;
    const std::vector<int> margin = brightness(x, from_y, 1, 600 - from_y);
    const auto end = std::ranges::find_if(margin, [](int value) { return value > kPanel; });
    return runs(brightness(x, from_y, 200, static_cast<int>(end - margin.begin())), from_y, kText, 6, 20);
  }
  // Until the program has drawn all it was asked for: it and the window manager neither work nor wait for a
  // processor, and the picture stands still. That is kept by the name then.
  void settle(const std::string& name = "still") {
    constexpr double kStretch_s = 0.3;  // a window at rest looks every 0.25 s whether there is more to draw
    constexpr double kTick_s = 0.01;    // what the system counts processors' time by
    const auto works = [this] { return program_->busy() || manager_->busy(); };
    EXPECT_TRUE(becomes([&] {
      grab(name);
      const double before_s = program_->cpu_s();
      if (works()) return false;
      pause_ms(static_cast<int>(1e3 * kStretch_s));
      if (works() || program_->cpu_s() - before_s > 2.5 * kTick_s) return false;
      return different_pixels(picture(name), screen_->picture_of(id())) == 0;
    })) << "the window does not come to rest";
  }
  // How many printed lines have these words in them.
  [[nodiscard]] long lines_of(const std::string& words) const {
    const std::string all = text_of(folder_ / "out.txt");
    long count = 0;
    for (std::size_t at = all.find(words); at != std::string::npos; at = all.find(words, at + 1)) ++count;
    return count;
  }
  [[nodiscard]] std::string errors() const { return text_of(folder_ / "err.txt"); }
  [[nodiscard]] static std::string scene(const std::string& name) {
    return std::string(PINOCCHIO_SOURCE_DIR "/scenes/") + name;
  }
  // Closed by the window manager, as a person would; it has said one line with `said` in it, or nothing, and
  // leaves well.
  void expect_clean_close(const std::string& said = "") {
    // A key that the window manager gets while it still frames a new window is lost: a person presses again.
    for (int presses = 0; presses < 5 && program_->running(); ++presses) {
      xdo("windowfocus --sync " + window_ + " key alt+F4");
      (void)program_->wait(5.0);
    }
    EXPECT_EQ(program_->wait(), 0) << errors();
    EXPECT_NE(errors().find(said), std::string::npos) << errors();
    EXPECT_EQ(std::ranges::count(errors(), '\n'), said.empty() ? 0 : 1) << errors();
  }

  std::filesystem::path folder_;
  std::string display_, window_;
  std::optional<Process> server_, manager_, program_;
  std::optional<Screen> screen_;
  std::map<std::string, Picture> pictures_;

 private:
  void start_display() {
    const std::filesystem::path number = folder_ / "display.txt";
    server_.emplace(std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0", "1280x800x24",
                                             "-noreset", "-nolisten", "tcp"},
                    folder_, std::vector<std::string>{}, number, folder_ / "xvfb.txt");
    ASSERT_TRUE(becomes([&] { return text_of(number).find('\n') != std::string::npos; }))
        << text_of(folder_ / "xvfb.txt");
    display_ = ":" + text_of(number);
    display_.pop_back();
    screen_.emplace(display_);
    // A window that is opened before it has taken over the display may be overlooked: it says when it has.
    manager_.emplace(
        std::vector<std::string>{"openbox", "--startup", "touch '" + (folder_ / "managed").string() + "'"},
        folder_, std::vector<std::string>{"DISPLAY=" + display_}, folder_ / "openbox.txt",
        folder_ / "openbox.txt");
    ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "managed"); }));
  }
};

}  // namespace pinocchio
