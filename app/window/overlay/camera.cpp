// The panel Camera.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>

#include "app/window/overlay/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

struct ActionButton {
  const char* name;
  Action action;
  const char* help;
};

void draw_buttons(Model& model, std::initializer_list<ActionButton> buttons) {
  bool first = true;
  for (const auto& [name, action, help] : buttons) {
    if (!std::exchange(first, false)) ImGui::SameLine();
    if (button(name, help)) model.requested.push_back(action);
  }
}

bool edit_vector(const char* name, glm::vec3& value, float speed, const std::string& help) {
  label(name, help);
  ImGui::PushID(name);
  const bool changed = ImGui::DragFloat3("##vector", &value.x, speed, 0.0f, 0.0f, "%.2f");
  ImGui::PopID();
  tooltip(help + "; drag, or Ctrl + click to type a number");
  return changed;
}

// Shows what the projection has: a field of view and a lens, or a height.
bool edit_angle(Camera& camera, float speed) {
  if (camera.projection == Projection::panorama) return false;
  if (camera.projection == Projection::orthographic) {
    const std::string help = "from the lower to the upper edge, in the scene's units";
    label("height", help);
    const float before = camera.height, most = std::max(1e6f * speed, before);
    ImGui::DragFloat("##height", &camera.height, speed, speed, most, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    tooltip(help + "; drag, or Ctrl + click to type a number");
    return camera.height != before;
  }
  const bool is_fisheye = camera.projection == Projection::fisheye;
  bool changed = slider("field of view", camera.fov_deg, 5.0f, is_fisheye ? kWidestFisheye : 120.0f,
                        format("%.1f degrees", camera.fov_deg), "from the lower to the upper edge");
  if (is_fisheye) return changed;
  changed = slider("lens", camera.lens_radius, 0.0f, 20.0f * speed, format("%.3f", camera.lens_radius),
                   "radius of the lens in the scene's units: above 0, what is nearer or farther than the "
                   "target gets blurred once samples are gathered") ||
            changed;
  return changed;
}

void choose_projection(Model& model) {
  constexpr std::array<const char*, kProjectionNames.size()> kHelp{
      "what is farther away looks smaller", "parallel rays: what is farther away looks as large",
      "all directions, in latitude and longitude; drawn by the CPU",
      "a wide lens: the distance from the middle grows with the angle; drawn by the CPU"};
  const auto now = as_size(model.camera.camera().projection);
  label("projection", "how directions become places in the picture");
  if (ImGui::BeginCombo("##projection", std::string(kProjectionNames[now]).c_str())) {
    for (std::size_t i = 0; i < kProjectionNames.size(); ++i) {
      if (list_item(std::string(kProjectionNames[i]).c_str(), i == now))
        model.camera.set_projection(static_cast<Projection>(i));
      tooltip(kHelp[i]);
    }
    ImGui::EndCombo();
  }
  tooltip(kHelp[now]);
}

// A camera that is not at what it looks at.
void edit_camera(Model& model) {
  Camera camera = model.camera.camera();
  const float speed = std::max(1e-3f * model.stats.bounds.diagonal(), 1e-6f);
  bool changed =
      edit_vector("eye", camera.eye, speed, "position of the camera: x, y, z in the scene's units");
  changed =
      edit_vector("target", camera.target, speed,
                  "point that the camera looks at and turns around; double-click a surface to set it") ||
      changed;
  changed = edit_angle(camera, speed) || changed;
  const glm::vec3 forward = camera.target - camera.eye;
  const bool sees = glm::length(forward) > 1e-6f * std::max(glm::length(camera.target), 1e-6f) &&
                    glm::length(glm::cross(forward, camera.up)) > 1e-6f * glm::length(forward);
  if (changed && sees) model.camera.set_camera(camera);
}

}  // namespace

void draw_camera(Model& model, float) {
  edit_camera(model);
  choose_projection(model);
  draw_buttons(model, {{"Front", Action::view_front, "look along -z"},
                       {"Right", Action::view_right, "look along -x"},
                       {"Top", Action::view_top, "look along -y"}});
  draw_buttons(model, {{"Back", Action::view_back, "look along z"},
                       {"Left", Action::view_left, "look along x"},
                       {"Bottom", Action::view_bottom, "look along y"}});
  draw_buttons(model, {{"Fit", Action::frame_all, "show the whole scene, without the walls around it (F)"},
                       {"Reset", Action::reset_camera, "the camera as at the start (R)"},
                       {"Save", Action::save_camera, "save the camera to a file for render --path (C)"}});
  if (model.scene.cameras.empty()) return;
  ImGui::Separator();
  for (std::size_t i = 0; i < model.scene.cameras.size(); ++i) {
    const std::string& name = model.scene.cameras[i].name;
    ImGui::PushID(i);
    if (list_item((std::to_string(i + 1) + "  " + (name.empty() ? "camera" : name)).c_str()))
      model.camera_to_show = i;
    ImGui::PopID();
    tooltip("use this camera of the file");
  }
}

}  // namespace pinocchio::app
