// The panel Lights, and a mark for each light in the picture, which can be dragged.
#include <algorithm>
#include <string>

#include "app/window/camera/projection.h"
#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

constexpr float kMarkRadius = 7.0f;

// Scene units for each pixel of dragging a number.
float drag_speed(const Model& model) {
  return std::max(1e-3f * model.stats.bounds.diagonal(), 1e-6f);
}

// The light's size, for soft shadows.
bool edit_size(Light& light, const Model& model) {
  const LightSize* const size = kind_of(light).size;
  if (!size) return false;
  const bool is_length = size->largest == kAnyLength;
  const std::string name(size->name);
  label(name.c_str(),
        (std::string(size->what) + "; above 0, shadows are soft once samples are gathered").c_str());
  const bool changed = ImGui::DragFloat(("##" + name).c_str(), &(light.*size->value),
                                        is_length ? 0.25f * drag_speed(model) : 0.02f, 0.0f,
                                        std::min(size->largest, 1e6f), is_length ? "%.3f" : "%.2f");
  light.*size->value = glm::clamp(light.*size->value, 0.0f, size->largest);
  tooltip("drag, or Ctrl + click to type a number");
  return changed;
}

bool edit_light(Light& light, const Model& model) {
  const std::string shadows = (light.name.empty() ? "light" : light.name) + ": casts shadows";
  bool changed = checkbox(shadows.c_str(), light.casts_shadow, "off: its light passes through everything");
  const float speed = std::max(0.01f * light.intensity, 0.005f);
  if (kind_of(light).has_position) {
    label("position", "x y z in the scene's units; drag a number, or the light's mark in the picture");
    changed =
        ImGui::DragFloat3("##position", &light.position.x, drag_speed(model), 0.0f, 0.0f, "%.2f") || changed;
  } else {
    label("direction", "direction of its light, x y z");
    if (ImGui::DragFloat3("##direction", &light.direction.x, 0.01f, 0.0f, 0.0f, "%.2f")) {
      const float length = glm::length(light.direction);
      light.direction = length > 1e-6f ? light.direction / length : glm::vec3(0.0f, -1.0f, 0.0f);
      changed = true;
    }
  }
  tooltip("drag, or Ctrl + click to type a number");
  label("intensity", "multiplies the light's colour; 1: as bright as the file has white");
  if (ImGui::DragFloat("##intensity", &light.intensity, speed, 0.0f, 1e6f, "%.2f")) {
    light.intensity = std::max(light.intensity, 0.0f);
    changed = true;
  }
  tooltip("drag, or Ctrl + click to type a number");
  return edit_size(light, model) || changed;
}

// An invisible button under the mark receives the drag before the picture.
bool drag_mark(Light& light, int id, const Camera& camera, glm::vec2 display, float scale) {
  const std::optional<ScreenPoint> at = project(camera, display, light.position);
  if (!at) return false;
  const float radius = kMarkRadius * scale;
  ImGui::SetNextWindowPos(ImVec2(at->position.x - 1.5f * radius, at->position.y - 1.5f * radius));
  ImGui::SetNextWindowSize(ImVec2(3.0f * radius, 3.0f * radius));
  constexpr ImGuiWindowFlags kInvisible = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav |
                                          ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::Begin(("light " + std::to_string(id)).c_str(), nullptr, kInvisible);
  ImGui::InvisibleButton("mark", ImVec2(3.0f * radius, 3.0f * radius));
  const bool dragged = ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 0.0f);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s: drag to move", light.name.c_str());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 center(at->position.x, at->position.y);
  const ImU32 color = ImGui::ColorConvertFloat4ToU32(ImVec4(1.0f, 0.9f, 0.55f, 1.0f));
  list.AddCircle(center, radius + 1.0f, IM_COL32(0, 0, 0, 160), 0, 3.0f);
  if (light.casts_shadow) list.AddCircleFilled(center, 0.6f * radius, color);
  list.AddCircle(center, radius, color, 0, 1.5f);
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (!dragged) return false;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x == 0.0f && moved.y == 0.0f) return false;
  light.position += unproject_move(camera, display, at->z_eye, {moved.x, moved.y});
  return true;
}

}  // namespace

void draw_light_controls(Model& model, float) {
  if (!model.has_scene()) return paragraph("no scene");
  paragraph("Drag the marks in the picture, or the numbers.");
  for (std::size_t i = 0; i < model.scene.lights.size(); ++i) {
    ImGui::PushID(i);
    model.lights_changed = edit_light(model.scene.lights[i], model) || model.lights_changed;
    ImGui::PopID();
  }
}

void draw_light_handles(Model& model, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  for (std::size_t i = 0; i < model.scene.lights.size(); ++i)
    if (kind_of(model.scene.lights[i]).has_position)
      model.lights_changed =
          drag_mark(model.scene.lights[i], i, model.camera.camera(), {display.x, display.y}, scale) ||
          model.lights_changed;
}

}  // namespace pinocchio::app
