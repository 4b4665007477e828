#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/context.h"

namespace pinocchio::gl {

struct ContextRequest {
  std::string backend = "auto";  // "auto" (never "glfw"), "egl", "osmesa", "glfw"
  std::string device;            // EGL's device number, "software", or empty: the first that works
  bool debug = false;            // listen to the driver (Context::complaints)
};

// Opens the first context that works (probe.h), makes it current and returns it: hardware devices, then
// software ones, EGL's surfaceless platform, its default display, OSMesa. Throws NoContextError.
[[nodiscard]] std::unique_ptr<Context> open_context(const ContextRequest& request = {});

// Whether EGL's list of devices leaves hardware to be hoped for: false where all that it names is software,
// and no context need be opened to know what one would be. Where it cannot tell, true.
[[nodiscard]] bool may_be_hardware(const ContextRequest& request = {});

// One way to a context, tried.
struct Attempt {
  std::string what;
  std::string failure;  // empty: it works
  ContextInfo info;     // where it works
};

// Tries every way there is, each in a process of its own, so that a driver that crashes or hangs is a failure
// like any other. To be called before OpenGL is used and threads are started.
[[nodiscard]] std::vector<Attempt> try_all_contexts();

}  // namespace pinocchio::gl
