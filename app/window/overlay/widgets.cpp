#include "app/window/overlay/widgets.h"

#include <imgui_internal.h>  // BringWindowToDisplayFront

#include <array>
#include <cstdarg>
#include <cstdio>

#include "core/image/tonemap.h"

namespace pinocchio::app {
namespace {

constexpr const char* kWidestName = "throughput_cutoff ";
constexpr float kWidestValue = 7.0f;  // in heights of the font

float name_column() {
  return ImGui::CalcTextSize(kWidestName).x * 0.72f + ImGui::GetStyle().WindowPadding.x;
}

// Sets the control's width so that its value fits beside it.
void leave_room_for_value() {
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - kWidestValue * ImGui::GetFontSize());
}

void value_text(const std::string& text) {
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
}

// Dark on the accent's colour, unlike an item under the pointer.
void push_chosen() {
  for (const ImGuiCol which : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive,
                               ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive})
    ImGui::PushStyleColor(which, kAccent);
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.05f, 0.05f, 0.06f, 1.0f));
}
void pop_chosen() {
  ImGui::PopStyleColor(7);
}

}  // namespace

void tooltip(const std::string& text) {
  if (text.empty()) return;
  ImGui::LogText("[%s]", text.c_str());  // tests list every string
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
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

void label(const char* name, const std::string& help) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  tooltip(help);
  ImGui::SameLine(name_column());
  ImGui::SetNextItemWidth(-1.0f);
}

void row(const char* name, const std::string& value, const std::string& help) {
  ImGui::TextUnformatted(name);
  tooltip(help);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  ImGui::TextUnformatted(value.c_str());
}

void paragraph(const std::string& text) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

int choose(const char* name, const std::string& help, const std::vector<Choice>& choices,
           std::size_t chosen) {
  label(name, help);
  const float gap = 2.0f;
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = (room + gap) / choices.size() - gap;
  int clicked = -1;
  ImGui::PushID(name);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) ImGui::SameLine(0.0f, gap);
    if (i == chosen) push_chosen();
    ImGui::BeginDisabled(choices[i].broken);
    if (ImGui::Button(std::string(choices[i].text).c_str(), ImVec2(width, 0.0f))) clicked = i;
    ImGui::EndDisabled();
    if (i == chosen) pop_chosen();
    tooltip(choices[i]);
  }
  ImGui::PopID();
  return clicked;
}

bool slider(const char* name, float& value, float lo, float hi, const std::string& shown,
            const std::string& help) {
  label(name, help);
  leave_room_for_value();
  ImGui::PushID(name);
  const bool changed = ImGui::SliderFloat("##slider", &value, lo, hi, "");
  ImGui::PopID();
  tooltip(help);
  value_text(shown);
  return changed;
}

bool slider(const char* name, int& value, int lo, int hi, const std::string& shown, const std::string& help) {
  label(name, help);
  leave_room_for_value();
  ImGui::PushID(name);
  const bool changed = ImGui::SliderInt("##slider", &value, lo, hi, "");
  ImGui::PopID();
  tooltip(help);
  value_text(shown);
  return changed;
}

bool checkbox(const char* name, bool& value, const std::string& help) {
  const bool changed = ImGui::Checkbox(name, &value);
  tooltip(help);
  return changed;
}

bool button(const char* name, const std::string& help, bool chosen) {
  if (chosen) push_chosen();
  const bool clicked = ImGui::Button(name);
  if (chosen) pop_chosen();
  tooltip(help);
  return clicked;
}

bool edit_color(const char* name, glm::vec3& color, const std::string& help) {
  label(name, help);
  glm::vec3 shown(linear_to_srgb(color.x), linear_to_srgb(color.y), linear_to_srgb(color.z));
  ImGui::PushID(name);
  const bool changed =
      ImGui::ColorEdit3("##color", &shown.x,
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoOptions);
  ImGui::PopID();
  tooltip(help + "; sRGB: drag a number, Ctrl + click to type it, or click the swatch");
  if (changed) color = srgb_to_linear(glm::max(shown, glm::vec3(0.0f)));
  return changed;
}

void keep_in_front() {
  if (!ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup))
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

bool list_item(const char* name, bool chosen) {
  if (chosen) push_chosen();
  const bool clicked = ImGui::Selectable(name, chosen);
  if (chosen) pop_chosen();
  return clicked;
}

std::string format(const char* pattern, ...) {
  std::array<char, 512> text{};
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

}  // namespace pinocchio::app
