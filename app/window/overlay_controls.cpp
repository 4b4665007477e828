// What can be changed while it draws.
#include <algorithm>
#include <array>
#include <string>

#include "app/window/overlay_parts.h"

namespace pinocchio::app {
namespace {

// A row of buttons of which one is chosen.
template <class Value>
void choose(const char* name, const std::vector<const char*>& values, Value& chosen) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  const float indent = ImGui::CalcTextSize("resolution  ").x;
  const float gap = 2.0f;
  const float room = ImGui::GetContentRegionAvail().x - indent;
  const float width = (room + gap) / static_cast<float>(values.size()) - gap;
  ImGui::PushID(name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ImGui::SameLine(i == 0 ? indent + ImGui::GetStyle().WindowPadding.x : 0.0f, i == 0 ? -1.0f : gap);
    const bool is_chosen = static_cast<std::size_t>(chosen) == i;
    if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyle().Colors[ImGuiCol_ButtonActive]);
    if (ImGui::Button(values[i], ImVec2(width, 0.0f))) chosen = static_cast<Value>(i);
    if (is_chosen) ImGui::PopStyleColor();
  }
  ImGui::PopID();
}

// A name at the left, in one column with choose(); the control that follows takes the rest.
void label(const char* name) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  ImGui::SameLine(ImGui::CalcTextSize("resolution  ").x + ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextItemWidth(-1.0f);
}

void draw_plan_controls(ViewSettings& s) {
  std::vector<const char*> plans{"auto", "slides"};
  if (s.has_plan_file) plans.push_back("file");
  choose("plan", plans, s.plan);
  if (s.plan == PlanSource::file) return;  // it says the rest
  choose("mode", {"hybrid", "raytrace", "raster"}, s.mode);
  int design = s.design - 1;
  choose("design", {"1: on the GPU", "2: on the CPU"}, design);
  s.design = design + 1;
}

void draw_quality_controls(ViewSettings& s) {
  ImGui::Checkbox("shadows", &s.shadows);
  ImGui::SameLine();
  ImGui::Checkbox("reflections", &s.reflections);
  label("depth");
  ImGui::SliderInt("##depth", &s.depth, 0, 16, s.depth == 1 ? "%d bounce" : "%d bounces");
  label("exposure");
  ImGui::SliderFloat("##exposure", &s.exposure_ev, -8.0f, 8.0f, "%+.1f stops");
  label("resolution");
  ImGui::SliderFloat("##scale", &s.scale, kLeastScale, kMostScale, "%.2f of the window's");
  ImGui::Checkbox("gather samples", &s.accumulate);
  ImGui::SameLine();
  ImGui::Checkbox("vsync", &s.vsync);
}

void draw_looking(Model& model) {
  ViewSettings& s = model.settings;
  label("look at");
  const std::string chosen(kBufferViewNames[static_cast<std::size_t>(s.buffer)]);
  const int slots = model.scene ? model.scene.needs().casting_lights : 0;
  const bool is_mask = s.buffer == BufferView::mask;
  if (ImGui::BeginCombo("##buffer",
                        is_mask ? (chosen + " " + std::to_string(s.mask_slot)).c_str() : chosen.c_str())) {
    for (std::size_t i = 0; i < kBufferViewNames.size(); ++i) {
      const auto view = static_cast<BufferView>(i);
      for (int slot = 0; slot < (view == BufferView::mask ? std::max(slots, 1) : 1); ++slot) {
        std::string name(kBufferViewNames[i]);
        if (view == BufferView::mask) name += " " + std::to_string(slot);
        if (ImGui::Selectable(name.c_str(), s.buffer == view && (!is_mask || s.mask_slot == slot))) {
          s.buffer = view;
          s.mask_slot = slot;
        }
      }
    }
    ImGui::EndCombo();
  }
  choose("beside", {"off", "precise", "heat map"}, s.split);
}

void draw_camera(Model& model) {
  const Camera& camera = model.camera.camera();
  ImGui::Text("eye %.2f, %.2f, %.2f", static_cast<double>(camera.eye.x), static_cast<double>(camera.eye.y),
              static_cast<double>(camera.eye.z));
  if (ImGui::Button("whole scene")) model.asked.push_back(Action::frame_all);
  ImGui::SameLine();
  if (ImGui::Button("reset")) model.asked.push_back(Action::reset_camera);
  ImGui::SameLine();
  if (ImGui::Button("save")) model.asked.push_back(Action::save_camera);
  if (ImGui::Button("screenshot")) model.asked.push_back(Action::screenshot);
  ImGui::SameLine();
  if (ImGui::Button("print command")) model.asked.push_back(Action::print_command);
  ImGui::SameLine();
  if (ImGui::Button("keys")) model.asked.push_back(Action::help);
}

void draw_about(const Model& model) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::Text("%dx%d pixels%s, %d threads", model.picture_size.x, model.picture_size.y,
              model.samples > 1 ? (", " + std::to_string(model.samples) + " samples").c_str() : "",
              model.threads);
  ImGui::TextUnformatted(model.renderer.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_controls(Model& model, float) {
  draw_plan_controls(model.settings);
  choose("exchange", {"sync", "pipelined", "reproject"}, model.settings.exchange);
  ImGui::Separator();
  draw_quality_controls(model.settings);
  ImGui::Separator();
  draw_looking(model);
  if (model.scene && ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen))
    draw_light_controls(model);
  if (ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) draw_camera(model);
  ImGui::Separator();
  draw_about(model);
}

void draw_help() {
  if (!ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) return;
  const auto cell = [](const char* text, bool is_key) {
    ImGui::TableNextColumn();
    if (is_key) {
      ImGui::TextColored(ImVec4(0.98f, 0.72f, 0.38f, 1.0f), "  %s", text);
    } else {
      ImGui::TextUnformatted(text);
    }
  };
  constexpr std::array<std::array<const char*, 2>, 8> kOthers{
      {{"left drag", "orbit; look around while flying"},
       {"middle drag, Shift+left", "pan"},
       {"wheel, right drag", "zoom"},
       {"W A S D", "fly, Shift faster"},
       {"E Q", "fly up, down"},
       {"1 to 9", "the scene's cameras"},
       {"drop a file", "open it"},
       {"drag a light's mark", "move the light"}}};
  for (const auto& other : kOthers) {
    cell(other[0], true);
    cell(other[1], false);
  }
  const char* last = "";
  for (const KeyBinding& binding : key_bindings()) {
    if (std::string(last) == binding.what) continue;  // another key for the same
    last = binding.what;
    cell(binding.shown, true);
    cell(binding.what, false);
  }
  ImGui::EndTable();
}

}  // namespace pinocchio::app
