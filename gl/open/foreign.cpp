#include "gl/open/foreign.h"

#include <string>

#include "gl/context/error.h"

namespace pinocchio::gl {
namespace {

// Turns the caller's debug output off: some state can be queried only by provoking an error.
class Muted {
 public:
  Muted() {
    if (is_on_) glDisable(GL_DEBUG_OUTPUT);
  }
  ~Muted() {
    if (is_on_) glEnable(GL_DEBUG_OUTPUT);
  }
  Muted(const Muted&) = delete;
  Muted& operator=(const Muted&) = delete;

 private:
  bool is_on_ = glDebugMessageCallback && glIsEnabled(GL_DEBUG_OUTPUT);
};

}  // namespace

ForeignContext::ForeignContext(GetProcAddress get_proc_address, bool debug) try
    : get_proc_address_(get_proc_address), debug_(debug) {
  const KeepCurrent keep;
  load_functions();
  describe("foreign", "the caller's context", false);
} catch (const Error& error) {
  throw NoContextError(std::string("the caller's OpenGL context cannot be used: ") + error.what());
}

void ForeignContext::enter() {
  if (!is_bound())
    throw Error("the caller's OpenGL context is not current on this thread; make it current first");
  before_ = current;
  current = data();
  try {
    const Muted muted;
    state_.save();
  } catch (...) {
    current = before_;
    throw;
  }
  if (debug_) listen();
  run_deletions();
}

void ForeignContext::leave() noexcept {
  if (debug_) stop_listening();
  {
    const Muted muted;
    state_.restore();
    clear_errors();
  }
  current = before_;
}

void ForeignContext::listen() {
  if (!glDebugMessageCallback) return;
  listener_.output = glIsEnabled(GL_DEBUG_OUTPUT);
  listener_.synchronous = glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &listener_.callback);
  glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &listener_.user);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(collect, listener());
}

void ForeignContext::stop_listening() noexcept {
  if (!glDebugMessageCallback) return;
  glDebugMessageCallback(reinterpret_cast<GLDEBUGPROC>(listener_.callback), listener_.user);
  if (!listener_.output) glDisable(GL_DEBUG_OUTPUT);
  if (!listener_.synchronous) glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
}

}  // namespace pinocchio::gl
