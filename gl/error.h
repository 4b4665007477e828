#pragma once

#include <stdexcept>

namespace pinocchio::gl {

// The machine's OpenGL failed: out of memory, a shader that does not compile, a limit. what() is the line
// a person reads.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// No OpenGL context could be opened at all; what() lists what was tried and why each failed.
class NoContextError : public Error {
 public:
  using Error::Error;
};

// The GPU was reset, and the context is lost with all that was in it.
class ContextLostError : public Error {
 public:
  using Error::Error;
};

}  // namespace pinocchio::gl
