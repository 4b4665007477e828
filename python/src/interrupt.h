// Ctrl-C while Python waits for us.
#pragma once

#include <pinocchio/progress.h>

#include <csignal>
#include <optional>

#include "python/src/convert.h"

namespace pinocchio::python {

// While it lives, SIGINT cancels `progress`; then Python handles it. On threads other than Python's main one
// it does nothing, as signals are that one's. Made and ended with the GIL held.
class Interrupt {
 public:
  explicit Interrupt(Progress& progress);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  // Lets Python handle the signal that came meanwhile, and throws what that raised (KeyboardInterrupt).
  void check();

 private:
  Progress& progress_;
  bool watching_ = false;
  struct sigaction before_ {};
};

// Runs work(progress) without the GIL; Ctrl-C cancels it and is raised.
template <class Work>
auto without_gil(Work work) {
  Progress progress;
  Interrupt interrupt(progress);
  std::optional<decltype(work(&progress))> result;
  try {
    const nb::gil_scoped_release released;
    result = work(&progress);
  } catch (const Cancelled&) {
    interrupt.check();
    throw Error("interrupted");  // Python's handler raised nothing
  }
  interrupt.check();
  return std::move(*result);
}

}  // namespace pinocchio::python
