#include "python/src/support/interrupt.h"

namespace pinocchio::python {
namespace {

std::atomic<Progress*> watched{nullptr};

void cancel(int) {
  if (Progress* const progress = watched.load()) progress->cancel();
}

bool is_main_thread() {
  const nb::object threading = nb::module_::import_("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

Interrupt::Interrupt(Progress& progress) : progress_(progress), watching_(is_main_thread()) {
  sigaction(SIGINT, nullptr, &before_);
  // A shell starts background jobs with SIG_IGN. With SIG_DFL the signal ends the process.
  if (before_.sa_handler == SIG_IGN || before_.sa_handler == SIG_DFL) watching_ = false;
  if (!watching_) return;
  watched = &progress;
  struct sigaction action {};
  action.sa_handler = cancel;
  sigaction(SIGINT, &action, nullptr);
}

Interrupt::~Interrupt() {
  if (!watching_) return;
  sigaction(SIGINT, &before_, nullptr);
  watched = nullptr;
}

void Interrupt::check() {
  if (!watching_ || !progress_.cancelled()) return;
  sigaction(SIGINT, &before_, nullptr);
  PyErr_SetInterrupt();
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

}  // namespace pinocchio::python
