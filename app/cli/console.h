// The terminal: warnings, interrupts and progress.
#pragma once

#include <cstddef>
#include <string>

#include "pinocchio/load.h"
#include "pinocchio/progress.h"

namespace pinocchio::app {

// Replaces line breaks by blanks, as an error is one line.
[[nodiscard]] std::string one_line(std::string text);

// On stderr, a line each.
void print_warning(const std::string& warning);
void print_warnings(const Warnings& warnings);

// From here on SIGINT (Ctrl-C), SIGTERM and SIGHUP cancel run_progress(). Half a second later, or at a second
// signal, the program removes its part files and ends with kInterrupted: an OpenGL driver does not poll the
// progress.
void catch_interrupts();
// The progress of this run of the program, for all its long work.
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
