// The panel Lights, and a mark for each light in the picture, which can be dragged.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/window/camera/projection.h"
#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

constexpr float kMarkRadius = 7.0f;
constexpr const char* kDrag = "drag, or Ctrl + click to type a number";

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
  tooltip(kDrag);
  return changed;
}

// The angle of a spot's cone, from its axis.
bool edit_cone(Light& light) {
  float outer_deg = glm::degrees(std::acos(light.cos_outer));
  label("cone", "degrees from the spot's axis to where its light ends");
  const bool changed = ImGui::DragFloat("##cone", &outer_deg, 0.25f, 1.0f, 89.0f, "%.1f degrees");
  tooltip(kDrag);
  if (!changed) return false;
  light.cos_outer = std::cos(glm::radians(std::clamp(outer_deg, 1.0f, 89.0f)));
  light.cos_inner = std::max(light.cos_inner, light.cos_outer);
  return true;
}

bool edit_direction(Light& light) {
  label("direction", "direction of its light, x y z");
  const bool changed = ImGui::DragFloat3("##direction", &light.direction.x, 0.01f, 0.0f, 0.0f, "%.2f");
  tooltip(kDrag);
  const float length = glm::length(light.direction);
  if (changed) light.direction = length > 1e-6f ? light.direction / length : glm::vec3(0.0f, -1.0f, 0.0f);
  return changed;
}

bool edit_light(Light& light, const Model& model) {
  bool changed = checkbox("casts shadows", light.casts_shadow, "off: its light passes through everything");
  if (kind_of(light).has_position) {
    label("position", "x y z in the scene's units; drag a number, or the light's mark in the picture");
    changed =
        ImGui::DragFloat3("##position", &light.position.x, drag_speed(model), 0.0f, 0.0f, "%.2f") || changed;
    tooltip(kDrag);
  }
  if (kind_of(light).has_direction && !kind_of(light).has_sides) changed = edit_direction(light) || changed;
  if (kind_of(light).has_cone) changed = edit_cone(light) || changed;
  changed = edit_color("colour", light.color, "colour of its light") || changed;
  label("intensity", "multiplies the light's colour; 1: as bright as the file has white");
  const float speed = std::max(0.01f * light.intensity, 0.005f);
  if (ImGui::DragFloat("##intensity", &light.intensity, speed, 0.0f, 1e6f, "%.2f")) {
    light.intensity = std::max(light.intensity, 0.0f);
    changed = true;
  }
  tooltip(kDrag);
  return edit_size(light, model) || changed;
}

// Between the camera and what it looks at, above; it shines there.
Light new_light(const LightKind& kind, const Model& model) {
  constexpr float kCone_deg = 25.0f, kBright_deg = 20.0f;
  const Camera& camera = model.camera.camera();
  const CameraAxes axes = camera_axes(camera);
  const glm::vec3 to_eye = camera.eye - camera.target;
  const float distance = glm::length(to_eye);
  Light light;
  light.kind = kind.kind;
  light.name = "light " + std::to_string(model.scene.lights.size() + 1);
  light.position = camera.target + 0.4f * to_eye + 0.25f * distance * (axes.up + 0.5f * axes.right);
  light.direction = glm::normalize(camera.target - light.position);
  light.intensity = 0.5f;
  if (kind.has_cone) {
    light.cos_inner = std::cos(glm::radians(kBright_deg));
    light.cos_outer = std::cos(glm::radians(kCone_deg));
  }
  if (kind.has_sides) {
    light.edge_u = 0.2f * distance * glm::normalize(glm::cross(light.direction, axes.up));
    light.edge_v = glm::cross(light.direction, light.edge_u);
  }
  return light;
}

void draw_adding(Model& model) {
  ImGui::TextUnformatted("add a light");
  tooltip("between the camera and what it looks at");
  bool first = true;
  for (const LightKind& kind : kLightKinds) {
    if (!std::exchange(first, false)) ImGui::SameLine();
    if (!button(std::string(kind.name).c_str(), "add a light of this kind")) continue;
    model.scene.lights.push_back(new_light(kind, model));
    model.lights_changed = true;
  }
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
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 center(at->position.x, at->position.y);
  const ImU32 color = ImGui::ColorConvertFloat4ToU32(ImVec4(1.0f, 0.9f, 0.55f, 1.0f));
  list.AddCircle(center, radius + 1.0f, IM_COL32(0, 0, 0, 160), 0, 3.0f);
  if (light.casts_shadow) list.AddCircleFilled(center, 0.6f * radius, color);
  list.AddCircle(center, radius, color, 0, 1.5f);
  const bool hovered = ImGui::IsItemHovered();
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (hovered) ImGui::SetTooltip("%s: drag to move", light.name.c_str());  // with the usual padding
  if (!dragged) return false;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x == 0.0f && moved.y == 0.0f) return false;
  light.position += unproject_move(camera, display, at->z_eye, {moved.x, moved.y});
  return true;
}

}  // namespace

void draw_light_controls(Model& model, float scale) {
  if (!model.has_scene()) return paragraph("no scene");
  std::vector<Light>& lights = model.scene.lights;
  std::size_t removed = lights.size();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ImGui::PushID(i);
    const std::string name = lights[i].name.empty() ? "light" : lights[i].name;
    const std::string kind(kind_of(lights[i]).name);
    if (button("x", "remove this light (Ctrl + Z brings it back)")) removed = i;
    ImGui::SameLine();
    ImGui::TextColored(kAccent, "%s, %s", name.c_str(), kind.c_str());
    tooltip("its mark in the picture can be dragged");
    model.lights_changed = edit_light(lights[i], model) || model.lights_changed;
    ImGui::Dummy(ImVec2(0.0f, 2.0f * scale));
    ImGui::PopID();
  }
  if (removed < lights.size()) {
    lights.erase(lights.begin() + removed);
    model.lights_changed = true;
  }
  draw_adding(model);
  draw_environment(model);
  draw_background(model);
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
