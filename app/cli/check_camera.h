#pragma once

#include <string>

#include "pinocchio/camera.h"

namespace pinocchio::app {

// Ends the verb with kUsage where the camera is invalid; the line begins with `whose`.
void check_camera(const Camera& camera, const std::string& whose);

}  // namespace pinocchio::app
