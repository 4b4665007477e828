#include <algorithm>
#include <array>

#include "app/window/overlay/parts.h"
#include "core/compare/magma.h"

namespace pinocchio::app {
namespace {

constexpr float kMargin = 8.0f;

// A panel's width, and its first position: 0 to 1 of the available space.
struct Placement {
  float width, x, y;
  void (*draw)(Model&, float scale);
};
constexpr std::array<Placement, kPanels.size()> kPlaces{{
    {620.0f, 0.5f, 0.5f, draw_help},
    {300.0f, 0.0f, 0.0f, draw_figures},
    {350.0f, 1.0f, 0.0f, draw_controls},
    {350.0f, 1.0f, 0.0f, draw_all_settings},
    {300.0f, 0.0f, 1.0f, draw_light_controls},
    {300.0f, 0.0f, 0.5f, draw_camera},
    {320.0f, 1.0f, 0.5f, draw_materials},
    {340.0f, 1.0f, 1.0f, draw_pixel},
    {760.0f, 0.0f, 1.0f, draw_timeline},
    {460.0f, 0.5f, 0.2f, draw_files},
}};

// The window without margins and status line.
struct Area {
  ImVec2 lo, size;
};
Area panel_area(const Model& model, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = kMargin * scale;
  return {{margin, margin},
          {std::max(display.x - 2.0f * margin, 1.0f),
           std::max(display.y - 2.0f * margin - status_height(scale) - playback_height(model, scale), 1.0f)}};
}

// Panels stay inside a window that became smaller.
void keep_inside(const Area& area) {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const float x = std::max(std::min(at.x, area.lo.x + area.size.x - size.x), area.lo.x);
  const float y = std::max(std::min(at.y, area.lo.y + area.size.y - size.y), area.lo.y);
  if (x != at.x || y != at.y) ImGui::SetWindowPos(ImVec2(x, y));
}

void draw_panel(Panel panel, Model& model, float scale) {
  const auto i = static_cast<std::size_t>(panel);
  const Placement& place = kPlaces[i];
  const Area area = panel_area(model, scale);
  const float width = std::min(place.width * scale, area.size.x);
  ImGui::SetNextWindowPos(ImVec2(area.lo.x + place.x * area.size.x, area.lo.y + place.y * area.size.y),
                          ImGuiCond_FirstUseEver, ImVec2(place.x, place.y));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, area.size.y));
  const bool shown = ImGui::Begin(kPanels[i].title, &model.panels[panel],
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
  if (shown) place.draw(model, scale);
  keep_inside(area);
  ImGui::End();
}

// The line between the two halves, which can be dragged.
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

// The colours of the difference, from none to the largest.
void draw_color_scale(float scale) {
  constexpr int kSteps = 64;
  static const Image<glm::u8vec3> kColors = [] {
    Image<float> errors({kSteps, 1});
    for (int i = 0; i < kSteps; ++i) errors.at(i, 0) = 1.0f * i / (kSteps - 1);
    return magma(errors);
  }();
  ImGui::TextUnformatted("0 same");
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = 3.0f * scale, height = ImGui::GetTextLineHeight();
  for (int i = 0; i < kSteps; ++i) {
    const glm::u8vec3 c = kColors.at(i, 0);
    const float x = at.x + width * i;
    ImGui::GetWindowDrawList()->AddRectFilled({x, at.y}, {x + width, at.y + height},
                                              IM_COL32(c.r, c.g, c.b, 255));
  }
  ImGui::Dummy(ImVec2(width * kSteps, height));
  ImGui::SameLine();
  ImGui::TextUnformatted("1 black against white");
}

}  // namespace

// It lets the mouse through to the picture.
void draw_caption(Model& model, float scale) {
  if (model.legend.empty() && model.comparison.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = kMargin * scale;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, margin), ImGuiCond_Always, ImVec2(0.5f, 0.0f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(display.x - 2.0f * margin, display.y));
  ImGui::Begin("caption", nullptr,
               kBare | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(display.x - 4.0f * margin);
  if (!model.legend.empty()) ImGui::TextUnformatted(model.legend.c_str());
  if (!model.comparison.empty()) ImGui::TextUnformatted(model.comparison.c_str());
  ImGui::PopTextWrapPos();
  if (model.settings.split == Split::heat_map) draw_color_scale(scale);
  ImGui::End();
}

void draw_overlay(Model& model, float scale) {
  if (model.settings.overlay) {
    if (model.has_scene() && model.panels[Panel::lights] && model.zoom.factor <= 1.0f)
      draw_light_handles(model, scale);
    draw_divider(model, scale);
    draw_caption(model, scale);
    draw_status_line(model, scale);
    draw_playback(model, scale);
    for (std::size_t i = 0; i < kPanels.size(); ++i)
      if (const auto panel = static_cast<Panel>(i); model.panels[panel]) draw_panel(panel, model, scale);
  }
  draw_loading(model, scale);
  draw_messages(model, scale);
  draw_question(model, scale);
}

}  // namespace pinocchio::app
