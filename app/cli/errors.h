#pragma once

#include <stdexcept>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio::app {

enum ExitCode {
  kDone = 0,
  kFailed = 1,         // while running
  kUsage = 2,          // wrong command line
  kNoContext = 3,      // no OpenGL context
  kBadScene = 4,       // a scene or picture cannot be read
  kAboveLimit = 5,     // compare; also a picture without counterpart
  kInterrupted = 130,  // SIGINT, SIGTERM, SIGHUP
};

// Ends a verb: one line for stderr and the exit code. Thrown by verbs, caught once in main.
class Exit : public std::runtime_error {
 public:
  Exit(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// The value, or the end of the verb with `code`.
template <class T>
T value_or_exit(Expected<T> result, ExitCode code) {
  if (!result) throw Exit(code, result.error().message());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace pinocchio::app
