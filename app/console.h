// What a person at the terminal sees and does.
#pragma once

#include <cstddef>
#include <string>

namespace pinocchio::app {

// Line breaks become blanks: an error is one line.
[[nodiscard]] std::string one_line(std::string text);

// From here on Ctrl-C, or SIGTERM, asks for an end (interrupted()); a second one ends at once.
void catch_interrupts();
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
