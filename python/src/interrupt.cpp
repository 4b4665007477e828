#include "interrupt.h"

#include "convert.h"

namespace pinocchio::python {
namespace {

volatile std::sig_atomic_t noted = 0;

void note(int) { noted = 1; }

bool is_main_thread() {
  const nb::object threading = nb::module_::import_("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

Interrupt::Interrupt() : watching_(is_main_thread()) {
  if (!watching_) return;
  noted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  sigaction(SIGINT, &action, &before_);
}

Interrupt::~Interrupt() {
  if (watching_) sigaction(SIGINT, &before_, nullptr);
}

void Interrupt::check() {
  if (!watching_ || !noted) return;
  noted = 0;
  sigaction(SIGINT, &before_, nullptr);
  watching_ = false;
  PyErr_SetInterrupt();
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

void Interrupt::stop_if_noted() {
  if (noted) throw Stopped();
}

}  // namespace pinocchio::python
