#pragma once

#include "app/window/model.h"
#include "app/window/widgets.h"

namespace pinocchio::app {

// Who does a stage: a row of the timeline each.
enum class Lane { gpu, exchange, cpu, window };
[[nodiscard]] Lane lane_of(Stage stage, const Settings& settings);
[[nodiscard]] const char* lane_name(Lane lane);
[[nodiscard]] ImVec4 lane_color(Lane lane);
// A stage, in words.
[[nodiscard]] const char* stage_label(Stage stage);

// The panels' contents, each into the ImGui window that is open. scale: pixels for one of a usual display.
void draw_help(Model& model, float scale);
void draw_figures(Model& model, float scale);
void draw_controls(Model& model, float scale);
void draw_all_settings(Model& model, float scale);
void draw_light_controls(Model& model, float scale);
void draw_camera(Model& model, float scale);
// While the picture's light is counted; of the panel Drawing.
void draw_histogram(const Model& model, float scale);
void draw_timeline(Model& model, float scale);
void draw_pixel(Model& model, float scale);
void draw_materials(Model& model, float scale);
void draw_files(Model& model, float scale);

// One line at the window's lower edge.
void draw_status_line(Model& model, float scale);
[[nodiscard]] float status_height(float scale);
// What there is to say, above the status line.
void draw_messages(Model& model, float scale);
// Of an animated scene: play, pause, where its time is; above the status line.
void draw_playback(Model& model, float scale);
void draw_loading(Model& model, float scale);
// What the picture's colours mean, at the window's upper edge.
void draw_caption(Model& model, float scale);
// Over the picture, into no window: a handle at each light, to drag.
void draw_light_handles(Model& model, float scale);

}  // namespace pinocchio::app
