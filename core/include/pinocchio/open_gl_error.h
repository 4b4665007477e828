// Errors of OpenGL, as every program that draws may catch them. Pinocchio::core throws none of them.
#pragma once

#include "pinocchio/error.h"

namespace pinocchio {

// The machine's OpenGL failed: out of memory, a shader that does not compile, a limit. what() is the line
// a person reads.
class OpenGlError : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

// There is no OpenGL context that serves; what() lists what was tried and why each failed.
class NoOpenGlError : public OpenGlError {
 public:
  using OpenGlError::OpenGlError;
};

// The GPU was reset, and the context is lost with all that was in it.
class OpenGlLostError : public OpenGlError {
 public:
  using OpenGlError::OpenGlError;
};

}  // namespace pinocchio
