// Ctrl-C while Python waits for us.
#pragma once

#include <csignal>
#include <optional>

#include "convert.h"

namespace pinocchio::python {

// While it lives, SIGINT is noted instead of handled; then Python handles it. On threads other than Python's main
// one it does nothing, as signals are that one's. Made and ended with the GIL held.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  // With the GIL: lets Python handle what was noted, and throws what that raised (KeyboardInterrupt).
  void check();
  // Without it: throws Stopped once something was noted; for work that takes long.
  static void stop_if_noted();
  struct Stopped {};

 private:
  bool watching_ = false;
  struct sigaction before_ {};
};

// Runs `work` without the GIL; Ctrl-C ends it where it asks (stop_if_noted), and is raised.
template <class Work>
auto without_gil(Work work) {
  Interrupt interrupt;
  std::optional<decltype(work())> result;
  try {
    const nb::gil_scoped_release released;
    result = work();
  } catch (const Interrupt::Stopped&) {
    interrupt.check();
    throw Error("interrupted");  // Python's handler raised nothing
  }
  interrupt.check();
  return std::move(*result);
}

}  // namespace pinocchio::python
