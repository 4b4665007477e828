#pragma once

namespace pinocchio::app {

enum ExitCode {
  kDone = 0,
  kFailed = 1,         // while running
  kUsage = 2,          // wrong command line
  kNoContext = 3,      // no OpenGL context
  kBadScene = 4,       // scene cannot be read
  kAboveLimit = 5,     // compare
  kInterrupted = 130,  // SIGINT, SIGTERM, SIGHUP
};

}  // namespace pinocchio::app
