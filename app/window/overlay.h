#pragma once

#include "app/window/model.h"

namespace pinocchio::app {

// Describes the overlay to ImGui, between Gui's begin_frame and end_frame; edits the model where a person
// does. scale: pixels for one of a usual display.
void draw_overlay(Model& model, float scale);

}  // namespace pinocchio::app
