// What can be changed while it draws.
#include <algorithm>
#include <array>
#include <string>

#include "app/window/overlay_parts.h"

namespace pinocchio::app {
namespace {

// A row of buttons of which one is chosen; the one that is clicked, or -1.
int choose(const char* name, const std::vector<Choice>& choices, std::size_t chosen) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  const float indent = ImGui::CalcTextSize("resolution  ").x;
  const float gap = 2.0f;
  const float room = ImGui::GetContentRegionAvail().x - indent;
  const float width = (room + gap) / static_cast<float>(choices.size()) - gap;
  int clicked = -1;
  ImGui::PushID(name);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    ImGui::SameLine(i == 0 ? indent + ImGui::GetStyle().WindowPadding.x : 0.0f, i == 0 ? -1.0f : gap);
    if (i == chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyle().Colors[ImGuiCol_ButtonActive]);
    ImGui::BeginDisabled(choices[i].broken);
    if (ImGui::Button(std::string(choices[i].text).c_str(), ImVec2(width, 0.0f))) clicked = static_cast<int>(i);
    ImGui::EndDisabled();
    tooltip(choices[i]);
    if (i == chosen) ImGui::PopStyleColor();
  }
  ImGui::PopID();
  return clicked;
}

// A name at the left, in one column with choose(); the control that follows takes the rest.
void label(const char* name) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  ImGui::SameLine(ImGui::CalcTextSize("resolution  ").x + ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextItemWidth(-1.0f);
}

void draw_preset(const char* option, ViewSettings& s) {
  const std::vector<Choice> choices = preset_choices(option, s);
  const auto chosen = std::ranges::find(choices, preset_of(option, s), &Choice::text) - choices.begin();
  if (const int clicked = choose(option, choices, static_cast<std::size_t>(chosen)); clicked >= 0)
    choose_preset(option, choices[static_cast<std::size_t>(clicked)].text, s);
}

void draw_exchange(ViewSettings& s) {
  const Field& field = *find_field("exchange");
  const Exchange now = wanted_settings(s).exchange;
  if (const int clicked = choose("exchange", field_choices(field, s), static_cast<std::size_t>(now)); clicked >= 0)
    s.settings.exchange = static_cast<Exchange>(clicked);
}

void draw_quality_controls(ViewSettings& s) {
  ImGui::Checkbox("shadows", &s.shadows);
  ImGui::SameLine();
  ImGui::Checkbox("reflections", &s.reflections);
  label("depth");
  int depth = s.settings.depth;
  if (ImGui::SliderInt("##depth", &depth, 0, 16, depth == 1 ? "%d bounce" : "%d bounces"))
    s.settings.depth = depth;
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
  const int slots = model.stats.casting_lights;
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
  const std::vector<Choice> sides{{"off"}, {"precise"}, {"heat map"}};
  if (const int clicked = choose("beside", sides, static_cast<std::size_t>(s.split)); clicked >= 0)
    s.split = static_cast<Split>(clicked);
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
  if (ImGui::Button("keys")) model.settings.help = !model.settings.help;
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

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(26.0f * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void tooltip(const Choice& choice) {
  tooltip(choice.broken ? std::string(choice.broken->what) + "; " + std::string(choice.broken->remedy)
                        : std::string(choice.help));
}

void draw_controls(Model& model, float) {
  for (const char* const option : {"plan", "mode", "design"}) draw_preset(option, model.settings);
  draw_exchange(model.settings);
  ImGui::Separator();
  draw_quality_controls(model.settings);
  if (ImGui::CollapsingHeader("All settings")) draw_all_settings(model);
  ImGui::Separator();
  draw_looking(model);
  if (model.has_scene() && ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen))
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
