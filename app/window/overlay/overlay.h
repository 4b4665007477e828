#pragma once

#include "app/window/model/model.h"

namespace pinocchio::app {

// Describes the overlay to ImGui, within a frame of Gui; edits the model where a person edits it. scale:
// pixels for one of a usual display.
void draw_overlay(Model& model, float scale);

}  // namespace pinocchio::app
