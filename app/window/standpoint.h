#pragma once

#include "app/window/model/model.h"

namespace pinocchio::app {

// Moves the camera to where the whole scene is seen, before the walls around it. pixels: of the window.
void frame_all(Model& model, glm::ivec2 pixels);
// Moves the camera to the scene's camera of this number, from 0 on, if there is one.
void show_camera(Model& model, std::size_t number);

}  // namespace pinocchio::app
