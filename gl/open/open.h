#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/context/context.h"

namespace pinocchio::gl {

struct ContextRequest {
  std::string backend = "auto";  // "auto" (never "glfw"), "egl", "osmesa", "glfw"
  std::string device;            // EGL's device number, "software", or empty: the first that works
  bool debug = false;            // collect the driver's complaints (Context::complaints)
};

// Opens the first context that works (probe.h), makes it current and returns it: hardware devices, then
// software ones, EGL's surfaceless platform, its default display, OSMesa. Throws NoContextError.
[[nodiscard]] std::unique_ptr<Context> open_context(const ContextRequest& request = {});

// Whether a context may be a hardware device's. False: EGL's list of devices has only software, which is
// known without opening a context.
[[nodiscard]] bool may_be_hardware(const ContextRequest& request = {});

// The result of trying one way to a context.
struct Attempt {
  std::string what;
  std::string failure;  // empty: it works
  ContextInfo info;     // where it works
};

// Tries every way, each in a child process, so that a driver that crashes or hangs is a failure like any
// other. Call it before OpenGL is used and threads are started.
[[nodiscard]] std::vector<Attempt> try_all_contexts();

}  // namespace pinocchio::gl
