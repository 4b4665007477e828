#pragma once

#include "app/options.h"

namespace pinocchio::app {

// What `view` takes from the command line.
struct ViewOptions {
  DrawOptions draw;
  float exposure_ev = 0.0f;
  bool watch = false;  // load scene and shaders anew when they change
  bool vsync = true;
};

}  // namespace pinocchio::app
