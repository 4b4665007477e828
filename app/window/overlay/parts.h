#pragma once

#include "app/window/model/model.h"
#include "app/window/overlay/widgets.h"

namespace pinocchio::app {

// The processor or path of a stage: a row of the timeline each.
enum class Lane { gpu, exchange, cpu, window };
[[nodiscard]] Lane lane_of(Stage stage, const Settings& settings);
[[nodiscard]] ImVec4 lane_color(Lane lane);
// A stage in words.
[[nodiscard]] const char* stage_label(Stage stage);

// Describes the overlay to ImGui, within a frame of Gui; edits the model where a person edits it. scale:
// pixels for one of a usual display.
void draw_overlay(Model& model, float scale);

// The panels' contents, each into the ImGui window that is open.
void draw_help(Model& model, float scale);
void draw_figures(Model& model, float scale);
void draw_controls(Model& model, float scale);
void draw_all_settings(Model& model, float scale);
void draw_light_controls(Model& model, float scale);
void draw_camera(Model& model, float scale);
// Part of the panel Lights.
void draw_environment(Model& model);
void draw_background(Model& model);
// Part of the panel Drawing, while the picture's light is counted.
void draw_histogram(const Model& model, float scale);
void draw_timeline(Model& model, float scale);
void draw_pixel(Model& model, float scale);
void draw_materials(Model& model, float scale);
void draw_files(Model& model, float scale);
void draw_scene(Model& model, float scale);
void draw_save(Model& model, float scale);

// One line at the window's lower edge.
void draw_status_line(Model& model, float scale);
[[nodiscard]] float status_height(float scale);
// Above the status line.
void draw_messages(Model& model, float scale);
// For an animated scene: play, pause and its time, above the status line.
void draw_playback(Model& model, float scale);
void draw_loading(Model& model, float scale);
// Whether edits that are not saved are dropped.
void draw_question(Model& model, float scale);
// The height of the animation's bar with the gap above it. 0: the scene has no animation.
[[nodiscard]] float playback_height(const Model& model, float scale);
// What the picture's colours mean, at the window's upper edge.
void draw_caption(Model& model, float scale);
// The light of each pixel, while pixels are enlarged so far that it can be read.
void draw_numbers(const Model& model);
// A handle at each light in the picture, which can be dragged.
void draw_light_handles(Model& model, float scale);

}  // namespace pinocchio::app
