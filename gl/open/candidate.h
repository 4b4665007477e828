#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gl/context/context.h"

namespace pinocchio::gl {

// A way to open a context.
struct Candidate {
  std::string backend;                                       // "egl", "osmesa", "glfw"
  std::string what;                                          // for messages
  std::optional<int> device;                                 // EGL's device number
  bool software = false;                                     // known before it is opened
  std::function<std::unique_ptr<Context>(bool debug)> open;  // throws Error with the reason
};

}  // namespace pinocchio::gl
