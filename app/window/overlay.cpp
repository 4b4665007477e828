#include "app/window/overlay.h"

#include <algorithm>
#include <cmath>

#include "app/window/overlay_parts.h"

namespace pinocchio::app {
namespace {

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
constexpr ImGuiWindowFlags kBare = kPanel | ImGuiWindowFlags_NoDecoration;
constexpr float kMargin = 10.0f, kPanelWidth = 318.0f, kTimelineHeight = 142.0f;

// A panel at the window's left or right edge, as high as its content, at most to the timeline.
void place_panel(bool at_right, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::min(kPanelWidth * scale, 0.42f * display.x), margin = kMargin * scale;
  const float highest = std::max(display.y - (kTimelineHeight + 3.0f * kMargin) * scale, 60.0f * scale);
  ImGui::SetNextWindowPos(ImVec2(at_right ? display.x - width - margin : margin, margin));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, highest));
}

void draw_panels(Model& model, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  place_panel(false, scale);
  ImGui::Begin("What a frame costs", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  draw_figures(model, scale);
  ImGui::End();

  place_panel(true, scale);
  ImGui::Begin("How it is drawn", nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
  draw_controls(model, scale);
  ImGui::End();

  const float margin = kMargin * scale;
  ImGui::SetNextWindowPos(ImVec2(margin, display.y - kTimelineHeight * scale - margin));
  ImGui::SetNextWindowSize(ImVec2(display.x - 2.0f * margin, kTimelineHeight * scale));
  ImGui::Begin("Timeline", nullptr, kBare);
  draw_timeline(model, scale);
  ImGui::End();
}

// A box of text in the middle, at `height` of the window (0 top, 1 bottom).
bool begin_message(const char* name, float height) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, height * display.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(0.7f * display.x, display.y));
  // The picture below takes the mouse.
  return ImGui::Begin(name, nullptr, kBare | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
}

void draw_loading(const SceneLoader::Progress& loading, float scale) {
  if (loading.phase.empty()) return;
  begin_message("loading", 0.5f);
  ImGui::Text("%s, %.1f s", loading.phase.c_str(), loading.seconds);
  // Nobody knows how long it will take: the bar shows that it goes on.
  const auto phase = static_cast<float>(std::fmod(loading.seconds, 2.0) / 2.0);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 220.0f * scale), height = 4.0f * scale;
  const float begin = std::max(phase * 1.3f - 0.3f, 0.0f) * width, end = std::min(phase * 1.3f, 1.0f) * width;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, ImVec2(at.x + width, at.y + height), IM_COL32(255, 255, 255, 30), height);
  list.AddRectFilled(ImVec2(at.x + begin, at.y), ImVec2(at.x + end, at.y + height),
                     IM_COL32(245, 170, 80, 255), height);
  ImGui::Dummy(ImVec2(width, height));
  ImGui::End();
}

void draw_errors(const Model& model) {
  if (!model.errors.empty()) {
    begin_message("error", 0.12f);
    ImGui::PushTextWrapPos(0.62f * ImGui::GetIO().DisplaySize.x);
    for (const auto& [what, error] : model.errors)
      ImGui::TextColored(ImVec4(1.0f, 0.45f, 0.38f, 1.0f), "%s", error.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
  }
}

void draw_notices(Model& model) {
  while (!model.notices.empty() && model.notices.front().until_s < now_s()) model.notices.pop_front();
  if (model.notices.empty()) return;
  begin_message("notices", 0.74f);
  ImGui::PushTextWrapPos(0.62f * ImGui::GetIO().DisplaySize.x);
  for (const Notice& notice : model.notices) ImGui::TextUnformatted(notice.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

// The line between the two halves, to drag, and what is on its right.
void draw_divider(Model& model, float scale) {
  if (model.settings.split == Split::off) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float x = model.settings.split_at * display.x, grip = 6.0f * scale;
  ImGui::SetNextWindowPos(ImVec2(x - grip, 0.0f));
  ImGui::SetNextWindowSize(ImVec2(2.0f * grip, display.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
  ImGui::Begin("divider", nullptr,
               kBare | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::InvisibleButton("grip", ImVec2(2.0f * grip, display.y));
  if (ImGui::IsItemActive()) model.settings.split_at += ImGui::GetIO().MouseDelta.x / display.x;
  const bool held = ImGui::IsItemActive() || ImGui::IsItemHovered();
  if (held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::GetBackgroundDrawList()->AddLine({x, 0.0f}, {x, display.y},
                                          IM_COL32(255, 255, 255, held ? 255 : 150), 1.5f * scale);
}

void draw_captions(const Model& model) {
  if (model.legend.empty() && model.comparison.empty()) return;
  begin_message("caption", 0.04f);
  if (!model.legend.empty()) ImGui::TextUnformatted(model.legend.c_str());
  if (!model.comparison.empty())
    ImGui::Text("left: as drawn   right: %s   %s",
                model.settings.split == Split::heat_map ? "difference (FLIP)" : "precise",
                model.comparison.c_str());
  ImGui::End();
}

}  // namespace

void draw_overlay(Model& model, float scale) {
  if (model.settings.overlay) {
    if (model.has_scene()) draw_light_handles(model, scale);
    draw_divider(model, scale);
    draw_captions(model);
    draw_panels(model, scale);
    draw_notices(model);
  }
  draw_loading(model.loading, scale);
  draw_errors(model);
  if (model.settings.help) {
    begin_message("keys", 0.5f);
    draw_help();
    ImGui::End();
  }
}

}  // namespace pinocchio::app
