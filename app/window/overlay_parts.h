#pragma once

#include <imgui.h>

#include "app/window/model.h"

namespace pinocchio::app {

// Who does a stage: a row of the timeline each.
enum class Lane { gpu, exchange, cpu, window };
[[nodiscard]] Lane lane_of(Stage stage, const Settings& settings);
[[nodiscard]] const char* lane_name(Lane lane);
[[nodiscard]] ImVec4 lane_color(Lane lane);

// While the pointer is on the last item.
void tooltip(const std::string& text);
// The rule that the choice would break, else its help.
void tooltip(const Choice& choice);

// The overlay's parts, each into the ImGui window that is open. scale: pixels for one of a usual display.
void draw_figures(const Model& model, float scale);
void draw_timeline(const Model& model, float scale);
void draw_controls(Model& model, float scale);
void draw_light_controls(Model& model);
// Every setting of the table, a row each.
void draw_all_settings(Model& model);
// Over the picture, into no window: a handle at each light, to drag.
void draw_light_handles(Model& model, float scale);
void draw_help();

}  // namespace pinocchio::app
