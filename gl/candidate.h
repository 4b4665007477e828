#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gl/context.h"

namespace pinocchio::gl {

// One way to a context, not yet tried.
struct Candidate {
  std::string backend;                                       // "egl", "osmesa", "glfw"
  std::string what;                                          // for people
  std::optional<int> device;                                 // EGL's device number
  bool software = false;                                     // known to be, before it is opened
  std::function<std::unique_ptr<Context>(bool debug)> open;  // throws Error that says why it cannot be
};

}  // namespace pinocchio::gl
