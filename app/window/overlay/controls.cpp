// The panel Drawing.
#include <algorithm>
#include <string>

#include "app/window/overlay/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

// The names of a plan's values in the window.
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
  if (const int clicked = choose(option, help, choices, chosen); clicked >= 0)
    choose_preset(option, values[clicked].text, s);
}

void draw_exchange(ViewSettings& s) {
  const Field& field = *find_field("exchange");
  const Exchange now = wanted_settings(s).exchange;
  if (const int clicked = choose("exchange", std::string(field.help), field_choices(field, s), as_size(now));
      clicked >= 0)
    s.settings.exchange = static_cast<Exchange>(clicked);
}

// A mode without tracing has neither, whatever is chosen for the others.
void draw_traced_parts(const Model& model, ViewSettings& s) {
  const bool traces = s.mode != "raster";
  const std::string none = "mode raster draws without shadows and reflections";
  bool shadows = traces && s.shadows, reflections = traces && s.reflections;
  ImGui::BeginDisabled(!traces);
  if (checkbox("shadows", shadows, traces ? help_of("mask_bits") : none)) s.shadows = shadows;
  ImGui::SameLine();
  if (checkbox("reflections", reflections, traces ? help_of("reflection") : none))
    s.reflections = reflections;
  ImGui::EndDisabled();
  if (model.given_up.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, kAccent);
  paragraph("While the picture moves, the budget leaves out: " + model.given_up);
  ImGui::PopStyleColor();
}

void draw_quality_controls(const Model& model, ViewSettings& s) {
  draw_traced_parts(model, s);
  int depth = s.settings.depth;
  if (slider("depth", depth, 0, 16, format(depth == 1 ? "%d bounce" : "%d bounces", depth), help_of("depth")))
    s.settings.depth = depth;
  slider("exposure", s.exposure_ev, -8.0f, 8.0f, format("%+.1f stops", s.exposure_ev),
         "brightness of the picture; one stop doubles the light");
  const std::vector<Choice> curves{
      {kToneMapNames[0], "light brighter than white is shown as white"},
      {kToneMapNames[1], "all light is shown darker, the brightest light most"},
      {kToneMapNames[2], "like film: more contrast, and highlights fade to white"},
      {kToneMapNames[3], "colours stay as they are, and highlights fade to white"}};
  choose_value("tone curve", "how light brighter than white is shown", curves, s.tone_map);
  slider("resolution", s.scale, kLeastScale, kMostScale, format("%.0f %%", 100.0 * s.scale),
         "pixels of the picture for one of the window, along a side");
  checkbox("edges", s.wireframe, "the edges of the visible triangles, over the picture (Z)");
  ImGui::SameLine();
  checkbox("gather samples", s.accumulate,
           "while the camera stands still, more samples for each pixel smooth the picture");
  ImGui::SameLine();
  checkbox("vsync", s.vsync, "wait for the display between pictures");
}

// The range that is shown of a channel whose values go beyond 0 to 1.
void draw_range(Model& model) {
  ViewSettings& s = model.settings;
  const int axes = layer_row(s.buffer).window.ranged_axes;
  if (axes == 0) return;
  bool automatic = !s.range;
  if (checkbox("automatic range", automatic, "from the scene's size")) {
    s.range.reset();
    if (!automatic) s.range = model.shown_range;
  }
  if (!s.range) return;
  const float speed = std::max(1e-3f * model.stats.bounds.diagonal(), 1e-6f);
  label("black at", "values in scene units");
  ImGui::DragScalarN("##lo", ImGuiDataType_Float, &s.range->lo.x, axes, speed, nullptr, nullptr, "%.3f");
  tooltip("drag, or Ctrl + click to type a number");
  label("white at", "values in scene units");
  ImGui::DragScalarN("##hi", ImGuiDataType_Float, &s.range->hi.x, axes, speed, nullptr, nullptr, "%.3f");
  tooltip("drag, or Ctrl + click to type a number");
}

void draw_shown(Model& model) {
  ViewSettings& s = model.settings;
  label("show", "the picture, or one of the channels it is made of");
  const auto name_of = [](Layer view, int slot) {
    std::string name(layer_row(view).window.name);
    if (view == Layer::mask) name += " " + std::to_string(slot);
    return name;
  };
  if (ImGui::BeginCombo("##buffer", name_of(s.buffer, s.mask_slot).c_str())) {
    for (std::size_t i = 0; i < kShownLayers; ++i) {
      const auto view = static_cast<Layer>(i);
      for (int slot = 0; slot < (view == Layer::mask ? std::max(model.stats.casting_lights, 1) : 1); ++slot)
        if (list_item(name_of(view, slot).c_str(),
                      s.buffer == view && (view != Layer::mask || s.mask_slot == slot))) {
          s.buffer = view;
          s.mask_slot = slot;
        }
    }
    ImGui::EndCombo();
  }
  tooltip("the picture, or one of the channels it is made of");
  draw_range(model);
  const std::vector<Choice> sides{
      {"off", "the picture alone"},
      {"reference", "the right half shows the reference, in double precision"},
      {"difference", "the right half shows how visible the difference from the reference is (FLIP)"}};
  choose_value("compare", "compare the picture with a reference, which is drawn in the background", sides,
               s.split);
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
  draw_preset("mode", "which processors draw", s);
  draw_preset("design", "where the picture is composited", s);
  draw_preset("plan", "what is sent between the processors", s);
  draw_exchange(s);
  ImGui::Separator();
  draw_quality_controls(model, s);
  draw_histogram(model, scale);
  ImGui::Separator();
  draw_shown(model);
  ImGui::Separator();
  draw_about(model);
}

}  // namespace pinocchio::app
