#include <imgui_internal.h>  // FindWindowByName, FindWindowSettings

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/window/overlay/parts.h"
#include "core/compare/magma.h"
#include "pinocchio/conversion.h"

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
    {520.0f, 1.0f, 0.0f, draw_all_settings},
    {300.0f, 0.0f, 1.0f, draw_light_controls},
    {300.0f, 0.0f, 0.5f, draw_camera},
    {340.0f, 1.0f, 0.5f, draw_materials},
    {340.0f, 1.0f, 1.0f, draw_pixel},
    {760.0f, 0.0f, 1.0f, draw_timeline},
    {460.0f, 0.5f, 0.2f, draw_files},
    {340.0f, 0.0f, 0.0f, draw_scene},
    {420.0f, 0.5f, 0.5f, draw_save},
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
ImVec2 inside(const Area& area, ImVec2 at, ImVec2 size) {
  return {std::max(std::min(at.x, area.lo.x + area.size.x - size.x), area.lo.x),
          std::max(std::min(at.y, area.lo.y + area.size.y - size.y), area.lo.y)};
}

// What the rectangle covers of the other open panels, pixels.
float covered(const Model& model, std::optional<Panel> panel, ImVec2 at, ImVec2 size) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    const auto other = static_cast<Panel>(i);
    const ImGuiWindow* const window = ImGui::FindWindowByName(kPanels[i].title);
    if (other == panel || !model.panels[other] || model.places.is_new[i] || !window) continue;
    const float width =
        std::min(at.x + size.x, window->Pos.x + window->Size.x) - std::max(at.x, window->Pos.x);
    const float height =
        std::min(at.y + size.y, window->Pos.y + window->Size.y) - std::max(at.y, window->Pos.y);
    if (width > 0.0f && height > 0.0f) sum += width * height;
  }
  return sum;
}

// The place that covers least of the other panels: its usual one, corners, or beside and below others.
ImVec2 free_place(const Model& model, std::optional<Panel> panel, const Area& area, ImVec2 usual, ImVec2 size,
                  float gap) {
  std::vector<ImVec2> places{usual};
  const float right = area.lo.x + area.size.x - size.x, bottom = area.lo.y + area.size.y - size.y;
  for (const float x : {area.lo.x, right})
    for (const float y : {area.lo.y, bottom}) places.emplace_back(x, y);
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    const ImGuiWindow* const other = ImGui::FindWindowByName(kPanels[i].title);
    if (!other || !model.panels[static_cast<Panel>(i)] || static_cast<Panel>(i) == panel) continue;
    const ImVec2 end(other->Pos.x + other->Size.x + gap, other->Pos.y + other->Size.y + gap);
    const ImVec2 before(other->Pos.x - size.x - gap, other->Pos.y - size.y - gap);
    for (const float x : {area.lo.x, right, other->Pos.x}) {
      places.emplace_back(x, end.y);
      places.emplace_back(x, before.y);
    }
    for (const float y : {area.lo.y, other->Pos.y}) {
      places.emplace_back(end.x, y);
      places.emplace_back(before.x, y);
    }
  }
  ImVec2 best = inside(area, usual, size);
  float least = covered(model, panel, best, size);
  for (const ImVec2& place : places) {
    const ImVec2 at = inside(area, place, size);
    const float lost = covered(model, panel, at, size);
    if (lost >= least) continue;
    best = at;
    least = lost;
  }
  return best;
}

float moved_with(float at, float size, float lo, float was, float is) {
  constexpr float kMiddle = 0.1f;  // of the area
  const float before = at - lo, behind = was - before - size;
  if (before > kMiddle * was && std::abs(before - behind) < kMiddle * was) return at + 0.5f * (is - was);
  return before <= behind ? at : at + is - was;
}

// Panels keep their distance from the nearer edges of a window that changes its size.
ImVec2 moved_with(PanelPlaces::Area& before, const Area& area, ImVec2 at, ImVec2 size) {
  const PanelPlaces::Area was = std::exchange(before, {area.size.x, area.size.y});
  if (was.width <= 0.0f) return at;
  return {moved_with(at.x, size.x, area.lo.x, was.width, area.size.x),
          moved_with(at.y, size.y, area.lo.y, was.height, area.size.y)};
}

void draw_panel(Panel panel, Model& model, float scale) {
  const auto i = as_size(panel);
  const Placement& place = kPlaces[i];
  const Area area = panel_area(model, scale);
  const float width = std::min(place.width * scale, area.size.x);
  const char* const title = kPanels[i].title;
  const bool is_known = ImGui::FindWindowByName(title) || ImGui::FindWindowSettings(ImHashStr(title));
  if (!is_known) model.places.is_new[i] = true;
  ImGui::SetNextWindowPos(ImVec2(area.lo.x + place.x * area.size.x, area.lo.y + place.y * area.size.y),
                          ImGuiCond_FirstUseEver, ImVec2(place.x, place.y));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, area.size.y));
  const bool shown = ImGui::Begin(title, &model.panels[panel],
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNavFocus);
  if (shown) place.draw(model, scale);
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImVec2 to = inside(area, moved_with(model.places.areas[i], area, at, size), size);
  // Its size is known once it was measured, in a frame that does not show it.
  if (model.places.is_new[i] && ImGui::GetCurrentWindow()->HiddenFramesCannotSkipItems == 0) {
    to = free_place(model, panel, area, to, size, kMargin * scale);
    model.places.is_new[i] = false;
  }
  if (to.x != at.x || to.y != at.y) ImGui::SetWindowPos(to);
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

// It lets the mouse through to the picture, and does not cover panels where there is room beside them.
void draw_caption(Model& model, float scale) {
  if (model.legend.empty() && model.comparison.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = kMargin * scale;
  const ImGuiWindow* const known = ImGui::FindWindowByName("caption");
  const ImVec2 size = known ? known->Size : ImVec2(0.0f, 0.0f);  // of the last frame
  const ImVec2 middle(0.5f * (display.x - size.x), margin);
  ImGui::SetNextWindowPos(free_place(model, std::nullopt, panel_area(model, scale), middle, size, margin));
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
    draw_numbers(model);
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
