// Part of the panel Lights: the light from all directions.
#include <filesystem>
#include <string>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {

void draw_environment(Model& model) {
  ImGui::Separator();
  const Environment* const environment = model.scene.environment.get();
  if (!environment)
    return paragraph("No environment: drop an .exr or .hdr picture on the window, or open one with F10.");
  const std::string& file = environment->source();
  if (button("x", "remove the environment (Ctrl + Z brings it back)")) model.drops_environment = true;
  ImGui::SameLine();
  const std::string name = std::filesystem::path(file).filename().string();
  ImGui::TextColored(kAccent, "%s", name.empty() ? "environment" : name.c_str());
  tooltip(file);
  Settings& settings = model.settings.settings;
  const Settings wanted = wanted_settings(model.settings);
  float turn_deg = wanted.environment_rotation, strength = wanted.environment_strength;
  if (slider("turn", turn_deg, -180.0f, 180.0f, format("%.0f degrees", turn_deg),
             std::string(find_field("environment_rotation")->help)))
    settings.environment_rotation = turn_deg;
  if (slider("strength", strength, 0.0f, 4.0f, format("%.2f", strength),
             std::string(find_field("environment_strength")->help)))
    settings.environment_strength = strength;
}

}  // namespace pinocchio::app
