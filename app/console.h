// What a person at the terminal sees and does.
#pragma once

#include <cstddef>
#include <string>

#include "pinocchio/progress.h"

namespace pinocchio::app {

// Line breaks become blanks: an error is one line.
[[nodiscard]] std::string one_line(std::string text);

// From here on SIGINT (Ctrl-C), SIGTERM and SIGHUP cancel run_progress(). What does not look at it, such as
// an OpenGL driver, gets half a second; then, or at a second signal, the program ends at once with
// kInterrupted and removes its part files.
void catch_interrupts();
// Of this run of the program, for all its long work: without phases of its own where several things go on.
[[nodiscard]] pinocchio::Progress& run_progress();
[[nodiscard]] bool interrupted();

// A bar on stderr, on a terminal only unless told otherwise; erased at the end.
class Progress {
 public:
  // mode: "auto", "on", "off"
  Progress(const std::string& mode, std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

 private:
  void draw() const;

  bool shown_;
  std::string what_;
  std::size_t done_ = 0, total_;
};

}  // namespace pinocchio::app
