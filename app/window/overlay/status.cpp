// What needs no panel: the status line, messages, and the progress of loading.
#include <algorithm>
#include <string>

#include "app/window/overlay/parts.h"
#include "hybrid/frame/schedule.h"

namespace pinocchio::app {
namespace {

constexpr float kPadding = 4.0f;
constexpr float kLeastShown_ms = 0.05f;  // less is shown as 0.0

std::string picture_text(const Model& model) {
  if (!model.has_scene()) return "no scene";
  std::string text = mode_name(model.drawn);
  if (!model.recording.empty()) text = "recording   " + text;
  if (model.unsaved) text += "   edited";
  if (model.is_cheaper) text += "   within the budget";
  if (model.zoom.factor > 1.0f) text += format("   enlarged %.1f times", model.zoom.factor);
  text += format("   %d sample%s a pixel", model.samples, model.samples == 1 ? "" : "s");
  return text;
}

std::string rate_text(const Model& model) {
  if (!model.has_scene()) return {};
  const float ms = median_of_newest(model.history.frame_ms(), kMedianOf);
  const std::string done = model.is_comparing ? "comparing" : "done";
  if (model.idle && !model.is_loading())
    return ms >= kLeastShown_ms ? done + format("   %.1f ms a frame", ms) : done;
  if (ms <= 0.0f) return "drawing";
  return format("%.1f frames/s   %.1f ms", model.history.rate(), ms);
}

void draw_panel_menu(Model& model) {
  if (!ImGui::BeginPopup("panels")) return;
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    bool& open = model.panels[static_cast<Panel>(i)];
    if (ImGui::MenuItem(kPanels[i].title, kPanels[i].key, open)) open = !open;
    tooltip(kPanels[i].what);
  }
  ImGui::EndPopup();
}

ImVec4 color_of(Messages::Kind kind) {
  if (kind == Messages::Kind::error) return {1.0f, 0.50f, 0.42f, 1.0f};
  if (kind == Messages::Kind::warning) return {1.0f, 0.80f, 0.36f, 1.0f};
  return {0.92f, 0.92f, 0.94f, 1.0f};
}

}  // namespace

float status_height(float scale) {
  return ImGui::GetFontSize() + 2.0f * kPadding * scale;
}

void draw_status_line(Model& model, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float height = status_height(scale);
  ImGui::SetNextWindowPos(ImVec2(0.0f, display.y - height));
  ImGui::SetNextWindowSize(ImVec2(display.x, height));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2.0f * kPadding * scale, 0.5f * kPadding * scale));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
  ImGui::Begin("status", nullptr, kBare | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar(4);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(rate_text(model).c_str());
  tooltip(
      "measured pictures a second, and the time from one to the next; 'done': the picture is finished, "
      "nothing is drawn until something changes");
  const float right = display.x - ImGui::CalcTextSize("Panels  F1 help ").x - 6.0f * kPadding * scale;
  const std::string what = picture_text(model);
  ImGui::SameLine(0.0f, 5.0f * kPadding * scale);
  if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(what.c_str()).x < right) {
    ImGui::TextUnformatted(what.c_str());
    tooltip("which processors draw, and the samples that each pixel has so far");
  } else {
    ImGui::NewLine();
  }
  ImGui::SameLine(std::max(right, 0.0f));
  if (button("Panels", "times, settings, lights, camera and more, over the picture"))
    ImGui::OpenPopup("panels");
  draw_panel_menu(model);
  ImGui::SameLine();
  if (button("F1 help", "mouse and keys")) model.panels.toggle(Panel::help);
  ImGui::End();
}

namespace {

// True: it is dismissed.
bool draw_message(const std::string& text, Messages::Kind kind, float width) {
  const bool dismissed = ImGui::SmallButton("x");
  tooltip("dismiss");
  ImGui::SameLine();
  ImGui::PushTextWrapPos(width);
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(kind));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  return dismissed;
}

// Several warnings take the place of one, until a person asks for all.
void draw_warnings(Model& model, float width) {
  const std::vector<Messages::Message>& all = model.messages.all();
  const auto is_warning = [](const Messages::Message& m) { return m.kind == Messages::Kind::warning; };
  const std::ptrdiff_t count = std::ranges::count_if(all, is_warning);
  if (count == 0) return;
  ImGui::PushID("warnings");
  const Messages::Message& first = *std::ranges::find_if(all, is_warning);
  bool dismissed = draw_message(first.text, Messages::Kind::warning, width);
  if (count > 1) {
    const std::string more = model.all_warnings ? "fewer" : std::to_string(count - 1) + " more";
    if (button(more.c_str(), "all warnings about this scene, or the first alone"))
      model.all_warnings = !model.all_warnings;
  }
  ImGui::PushTextWrapPos(width);
  for (const Messages::Message& message : all)
    if (model.all_warnings && is_warning(message) && &message != &first)
      ImGui::TextColored(color_of(message.kind), "%s", message.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopID();
  if (dismissed) model.messages.clear_warnings();
}

}  // namespace

void draw_messages(Model& model, float scale) {
  const std::vector<Messages::Message>& all = model.messages.all();
  // Warnings and errors are shown even while the overlay is hidden.
  const auto is_shown = [&](const Messages::Message& m) {
    return model.settings.overlay || m.kind != Messages::Kind::news;
  };
  if (std::ranges::none_of(all, is_shown)) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = 2.0f * kPadding * scale, width = std::min(0.7f * display.x, 560.0f * scale);
  const float below = model.settings.overlay ? status_height(scale) + playback_height(model, scale) : 0.0f;
  ImGui::SetNextWindowPos(ImVec2(margin, display.y - margin - below), ImGuiCond_Always, ImVec2(0.0f, 1.0f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(width, 0.6f * display.y));
  ImGui::Begin("messages", nullptr,
               (kBare & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  keep_in_front();
  draw_warnings(model, width - 3.0f * margin);
  std::size_t dismissed = all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_shown(all[i]) || all[i].kind == Messages::Kind::warning) continue;
    ImGui::PushID(i);
    if (draw_message(all[i].text, all[i].kind, width - 3.0f * margin)) dismissed = i;
    if (model.is_over_limit && all[i].about == "scene" &&
        button("Open it anyway", "without a limit of memory, if the file is to be trusted"))
      model.requested.push_back(Action::open_unlimited);
    ImGui::PopID();
  }
  model.messages.dismiss(dismissed);
  ImGui::End();
}

void draw_loading(Model& model, float scale) {
  const SceneLoader::Progress& loading = model.loading;
  if (loading.phase.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 2.0f * kPadding * scale), ImGuiCond_Always,
                          ImVec2(0.5f, 0.0f));
  ImGui::Begin("loading", nullptr,
               kBare | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  const float most = 0.9f * display.x;
  ImGui::PushTextWrapPos(most);
  ImGui::Text("%s, %.1f s", loading.phase.c_str(), loading.seconds);
  ImGui::PopTextWrapPos();
  if (button("Cancel", "stop, and keep what is shown")) model.requested.push_back(Action::cancel_loading);
  ImGui::SameLine();
  const float width = std::min(220.0f * scale, most - ImGui::GetCursorPosX());
  const float share = std::clamp(loading.share, 0.0, 1.0);
  ImGui::ProgressBar(share, ImVec2(width, 0.0f), format("%.0f %%", 100.0 * share).c_str());
  ImGui::End();
}

}  // namespace pinocchio::app
