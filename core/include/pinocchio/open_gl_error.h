// OpenGL's errors, for every program that draws. Pinocchio::core does not throw them.
#pragma once

#include "pinocchio/error.h"

namespace pinocchio {

// The machine's OpenGL failed: out of memory, a shader that does not compile, a limit. what() is one line for
// the user.
class OpenGlError : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

// There is no usable OpenGL context. what() lists what was tried and why each failed.
class NoOpenGlError : public OpenGlError {
 public:
  using OpenGlError::OpenGlError;
};

// The GPU was reset, and the context is lost with all its objects.
class OpenGlLostError : public OpenGlError {
 public:
  using OpenGlError::OpenGlError;
};

}  // namespace pinocchio
