// A display of the test's own (Xvfb) with a window manager, and the program in a window on it, driven by real
// key and mouse events.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/own_file.h"

namespace pinocchio {

inline void pause_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Looks again and again until it holds; false after `seconds`.
template <class Condition>
bool becomes(Condition holds, double seconds = 60.0) {
  for (int i = 0; i < static_cast<int>(20.0 * seconds); ++i) {
    if (holds()) return true;
    pause_ms(50);
  }
  return holds();
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A program that runs beside the test; killed at the end.
class Process {
 public:
  // environment: "NAME=VALUE"; an empty value takes the name out.
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder,
          const std::vector<std::string>& environment, const std::filesystem::path& out,
          const std::filesystem::path& err) {
    id_ = fork();
    if (id_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing outlives the test
    for (const std::string& setting : environment) {
      const std::size_t at = setting.find('=');
      if (at + 1 == setting.size()) {
        unsetenv(setting.substr(0, at).c_str());
      } else {
        setenv(setting.substr(0, at).c_str(), setting.substr(at + 1).c_str(), 1);
      }
    }
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments.front(), arguments.data());
    _exit(127);
  }
  ~Process() {
    if (!running()) return;
    kill(id_, SIGTERM);  // an X server tidies up
    if (wait(10.0) != -2) return;
    kill(id_, SIGKILL);
    (void)wait(30.0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  void signal(int number) const { kill(id_, number); }
  [[nodiscard]] bool running() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    return !status_;
  }
  // Its exit code; -1: it was ended by a signal; -2: it still runs.
  [[nodiscard]] int wait(double seconds = 60.0) {
    if (!becomes([this] { return !running(); }, seconds)) return -2;
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : -1;
  }
  // Of all processors, since it began.
  [[nodiscard]] double cpu_s() const {
    const std::string stat = text_of("/proc/" + std::to_string(id_) + "/stat");
    std::istringstream rest(stat.substr(stat.rfind(')') + 2));
    std::string skipped;
    for (int field = 3; field < 14; ++field) rest >> skipped;  // proc(5): utime is the 14th
    double user = 0.0, system = 0.0;
    rest >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  // Resident memory, MB.
  [[nodiscard]] double memory_mb() const {
    std::ifstream in("/proc/" + std::to_string(id_) + "/statm");
    long long pages = 0, resident = 0;
    in >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
  }

 private:
  static void redirect(const std::filesystem::path& file, int to) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(opened, to);
  }

  pid_t id_ = 0;
  std::optional<int> status_;
};

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {"Xvfb", "openbox", "xdotool", "import", "compare"})
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
  void open_as_is(const std::string& scene, const std::string& size = "800x600", const std::string& options = "",
                  const std::vector<std::string>& environment = {}) {
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

  // The window manager may give the focus to it, and take it away, until it is settled.
  void wait_for_keys() {
    ASSERT_TRUE(becomes([this] {
      xdo("windowfocus --sync " + window_);
      key("p");
      pause_ms(400);
      return text_of(folder_ / "out.txt").find("pinocchio render") != std::string::npos;
    })) << errors();
    pause_ms(400);  // what a second P prints is not taken for a later one's
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

  // The window's inside, as the display has it.
  void grab(const std::string& file) const {
    (void)run_command(
        "cd '" + folder_.string() + "' && DISPLAY=" + display_ + " import -window " + window_ + " " + file,
        folder_);
  }
  // Pixels that differ; -1 where the pictures cannot be compared.
  [[nodiscard]] long long different(const std::string& a, const std::string& b) const {
    const CommandResult result =
        run_command("cd '" + folder_.string() + "' && compare -metric AE " + a + " " + b + " null:", folder_);
    if (result.exit_code > 1) return -1;
    return std::llround(std::stod(result.err));
  }
  // Until the picture stands still.
  void settle() const {
    grab("settle-a.png");
    (void)becomes([this] {
      pause_ms(200);
      grab("settle-b.png");
      const bool still = different("settle-a.png", "settle-b.png") == 0;
      std::filesystem::rename(folder_ / "settle-b.png", folder_ / "settle-a.png");
      return still;
    });
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
    manager_.emplace(std::vector<std::string>{"openbox"}, folder_,
                     std::vector<std::string>{"DISPLAY=" + display_}, folder_ / "openbox.txt",
                     folder_ / "openbox.txt");
    // Window managers say how many desktops there are.
    ASSERT_TRUE(becomes([this] { return !xdo("get_num_desktops").empty(); }));
    pause_ms(700);  // and then take over what is there: a window that is opened meanwhile may be overlooked
  }
};

}  // namespace pinocchio
