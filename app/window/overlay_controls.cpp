// What can be changed while it draws.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "app/window/overlay_parts.h"

namespace pinocchio::app {
namespace {

// What is said of a plan's values.
std::string_view shown_name(std::string_view value) {
  return value == "slides" ? "fixed" : value == "auto" ? "as needed" : value;
}

std::string help_of(const char* field) {
  return std::string(find_field(field)->help);
}

void draw_preset(const char* option, const std::string& help, ViewSettings& s) {
  std::vector<Choice> choices = preset_choices(option, s);
  const auto chosen = std::ranges::find(choices, preset_of(option, s), &Choice::text) - choices.begin();
  const std::vector<Choice> values = choices;
  if (std::string_view(option) == "plan")
    for (Choice& choice : choices) choice.text = shown_name(choice.text);
  if (const int clicked = choose(option, help, choices, static_cast<std::size_t>(chosen)); clicked >= 0)
    choose_preset(option, values[static_cast<std::size_t>(clicked)].text, s);
}

void draw_exchange(ViewSettings& s) {
  const Field& field = *find_field("exchange");
  const Exchange now = wanted_settings(s).exchange;
  if (const int clicked =
          choose("exchange", std::string(field.help), field_choices(field, s), static_cast<std::size_t>(now));
      clicked >= 0)
    s.settings.exchange = static_cast<Exchange>(clicked);
}

void draw_quality_controls(ViewSettings& s) {
  checkbox("shadows", s.shadows, help_of("mask_bits"));
  ImGui::SameLine();
  checkbox("reflections", s.reflections, help_of("reflection"));
  int depth = s.settings.depth;
  if (slider("depth", depth, 0, 16, format(depth == 1 ? "%d bounce" : "%d bounces", depth), help_of("depth")))
    s.settings.depth = depth;
  slider("exposure", s.exposure_ev, -8.0f, 8.0f, format("%+.1f stops", static_cast<double>(s.exposure_ev)),
         "how bright the picture is shown; a stop is twice the light");
  const std::vector<Choice> curves{{kToneMapNames[0], "what is brighter than white is white"},
                                   {kToneMapNames[1], "all light is shown darker, the brightest most"},
                                   {kToneMapNames[2], "as film: more contrast, highlights fade to white"}};
  if (const int clicked = choose("tone curve", "how light brighter than white is shown", curves,
                                 static_cast<std::size_t>(s.tone_map));
      clicked >= 0)
    s.tone_map = static_cast<ToneMap>(clicked);
  slider("resolution", s.scale, kLeastScale, kMostScale,
         format("%.0f %%", 100.0 * static_cast<double>(s.scale)),
         "pixels that are drawn for the window's, along a side");
  checkbox("gather samples", s.accumulate,
           "while the camera stands still, more samples a pixel smooth the picture");
  ImGui::SameLine();
  checkbox("vsync", s.vsync, "wait for the display between pictures");
}

// What is black and what is white of a channel that has values beyond 0 to 1.
void draw_range(Model& model) {
  ViewSettings& s = model.settings;
  if (s.buffer != BufferView::depth && s.buffer != BufferView::position) return;
  bool automatic = !s.range;
  if (checkbox("automatic range", automatic, "from the scene's size")) {
    s.range.reset();
    if (!automatic) s.range = model.shown_range;
  }
  if (!s.range) return;
  const float speed = std::max(1e-3f * model.stats.bounds.diagonal(), 1e-6f);
  const int axes = s.buffer == BufferView::depth ? 1 : 3;
  label("black at", "values in scene units");
  ImGui::DragScalarN("##lo", ImGuiDataType_Float, &s.range->lo.x, axes, speed, nullptr, nullptr, "%.3f");
  tooltip("drag, or Ctrl + click to type a number");
  label("white at", "values in scene units");
  ImGui::DragScalarN("##hi", ImGuiDataType_Float, &s.range->hi.x, axes, speed, nullptr, nullptr, "%.3f");
  tooltip("drag, or Ctrl + click to type a number");
}

void draw_looking(Model& model) {
  ViewSettings& s = model.settings;
  label("show", "the picture, or a channel that it is made of");
  const auto name_of = [](BufferView view, int slot) {
    std::string name(kBufferViewNames[static_cast<std::size_t>(view)]);
    if (view == BufferView::mask) name += " " + std::to_string(slot);
    return name;
  };
  if (ImGui::BeginCombo("##buffer", name_of(s.buffer, s.mask_slot).c_str())) {
    for (std::size_t i = 0; i < kBufferViewNames.size(); ++i) {
      const auto view = static_cast<BufferView>(i);
      for (int slot = 0; slot < (view == BufferView::mask ? std::max(model.stats.casting_lights, 1) : 1);
           ++slot)
        if (line_of_list(name_of(view, slot).c_str(),
                         s.buffer == view && (view != BufferView::mask || s.mask_slot == slot))) {
          s.buffer = view;
          s.mask_slot = slot;
        }
    }
    ImGui::EndCombo();
  }
  tooltip("the picture, or a channel that it is made of");
  draw_range(model);
  const std::vector<Choice> sides{{"off", "the picture alone"},
                                  {"reference", "the reference, in double precision, in the right half"},
                                  {"difference", "how visible the difference from the reference is (FLIP)"}};
  if (const int clicked = choose("compare", "the picture with a reference, drawn in the background", sides,
                                 static_cast<std::size_t>(s.split));
      clicked >= 0)
    s.split = static_cast<Split>(clicked);
}

void draw_about(const Model& model) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
  paragraph(format("%d x %d pixels, %d thread%s", model.picture_size.x, model.picture_size.y, model.threads,
                   model.threads == 1 ? "" : "s"));
  paragraph(model.renderer);
  ImGui::PopStyleColor();
}

}  // namespace

void draw_controls(Model& model, float scale) {
  ViewSettings& s = model.settings;
  draw_preset("mode", "who draws", s);
  draw_preset("design", "where the picture is put together", s);
  draw_preset("plan", "what is sent between the processors", s);
  draw_exchange(s);
  ImGui::Separator();
  draw_quality_controls(s);
  draw_histogram(model, scale);
  ImGui::Separator();
  draw_looking(model);
  ImGui::Separator();
  draw_about(model);
}

void draw_camera(Model& model, float) {
  const Camera& camera = model.camera.camera();
  const auto row_of = [](const char* name, const glm::vec3& v, const char* help) {
    row(name,
        format("%.2f, %.2f, %.2f", static_cast<double>(v.x), static_cast<double>(v.y),
               static_cast<double>(v.z)),
        help);
  };
  row_of("eye", camera.eye, "where the camera is: x, y, z in the scene's units");
  row_of("target", camera.target, "what it looks at and turns around; double-click a surface to set it");
  row("field of view", format("%.1f degrees", static_cast<double>(camera.fov_deg)),
      "from lower to upper edge");
  struct Ask {
    const char* name;
    Action action;
    const char* help;
  };
  const auto draw = [&model](std::initializer_list<Ask> asks) {
    bool first = true;
    for (const Ask& ask : asks) {
      if (!std::exchange(first, false)) ImGui::SameLine();
      if (button(ask.name, ask.help)) model.asked.push_back(ask.action);
    }
  };
  draw({{"Fit", Action::frame_all, "what matters of the scene in view (F)"},
        {"Reset", Action::reset_camera, "as at the start (R)"},
        {"Save", Action::save_camera, "to a file for render --path (C)"}});
  draw({{"Front", Action::view_front, "along -z"},
        {"Right", Action::view_right, "along -x"},
        {"Top", Action::view_top, "along -y"}});
  draw({{"Screenshot", Action::screenshot, "PNG of the window, EXR of the picture (F12)"},
        {"Print command", Action::print_command, "that renders this without a window (P)"}});
  if (model.scene.cameras.empty()) return;
  ImGui::Separator();
  for (std::size_t i = 0; i < model.scene.cameras.size(); ++i) {
    const std::string& name = model.scene.cameras[i].name;
    ImGui::PushID(static_cast<int>(i));
    if (line_of_list((std::to_string(i + 1) + "  " + (name.empty() ? "camera" : name)).c_str()))
      model.camera_to_show = static_cast<int>(i);
    ImGui::PopID();
    tooltip("look through this camera of the file");
  }
}

}  // namespace pinocchio::app
