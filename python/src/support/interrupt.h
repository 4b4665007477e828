// Ctrl-C while Python waits for a call of this module.
#pragma once

#include <pinocchio/progress.h>

#include <csignal>
#include <optional>

#include "python/src/support/convert.h"

namespace pinocchio::python {

// During its lifetime SIGINT cancels `progress`, and Python handles the signal afterwards. It does nothing on
// threads other than Python's main one, which gets the signals. Construct and destroy it with the GIL held.
class Interrupt {
 public:
  explicit Interrupt(Progress& progress);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  // Lets Python handle a signal that has arrived, and throws the exception that Python raises
  // (KeyboardInterrupt).
  void check();

 private:
  Progress& progress_;
  bool watching_ = false;
  struct sigaction before_ {};
};

// Runs work(progress) without the GIL. Ctrl-C cancels it and raises KeyboardInterrupt.
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
    throw Error("interrupted");  // Python's handler raised no exception
  }
  interrupt.check();
  return std::move(*result);
}

}  // namespace pinocchio::python
