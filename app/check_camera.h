#pragma once

#include <string>

#include "pinocchio/camera.h"

namespace pinocchio::app {

// Ends the verb with kUsage where nothing can be seen from there: `whose` begins the line.
void check_camera(const Camera& camera, const std::string& whose);

}  // namespace pinocchio::app
