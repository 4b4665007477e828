// The panel All settings: for each its name, its value, and a button that goes back to the default.
#include <array>
#include <string>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

// A setting and its value.
struct Row {
  const Field& field;
  Model& model;
  std::string text;             // the value
  std::vector<Choice> choices;  // empty: numbers from lo to hi

  void set(std::string_view value) const {
    if (!field.take(value, model.settings.settings))
      model.messages.hint(std::string(field.name) + " is " + field.domain());
  }
};

void edit_flag(const Row& row) {
  bool on = row.text == "true";
  const Choice& other = row.choices[on ? 0 : 1];
  ImGui::BeginDisabled(other.broken);
  if (ImGui::Checkbox("##flag", &on)) row.set(other.text);
  ImGui::EndDisabled();
  tooltip(other);
}

void edit_choice(const Row& row) {
  if (!ImGui::BeginCombo("##choice", row.text.c_str())) return tooltip(std::string(row.field.help));
  for (const Choice& choice : row.choices) {
    ImGui::BeginDisabled(choice.broken);
    if (list_item(std::string(choice.text).c_str(), choice.text == row.text)) row.set(choice.text);
    ImGui::EndDisabled();
    tooltip(choice);
  }
  ImGui::EndCombo();
}

// The value counts after Enter, so that no tree is built for every digit.
void edit_number(const Row& row) {
  std::array<char, 32> text{};
  row.text.copy(text.data(), text.size() - 1);
  if (ImGui::InputText("##number", text.data(), text.size(),
                       ImGuiInputTextFlags_CharsScientific | ImGuiInputTextFlags_EnterReturnsTrue))
    row.set(text.data());
  tooltip(std::string(row.field.help) + ": " + row.field.domain() + ", then Enter");
}

void draw_row(const Row& row, const Settings& wanted) {
  const Field& field = row.field;
  Settings& settings = row.model.settings.settings;
  const bool given = field.given(settings);
  const bool by_others = field.given(wanted) && !(given && field.same(wanted, settings));
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::TextColored(style.Colors[given ? ImGuiCol_Text : ImGuiCol_TextDisabled], "%s",
                     std::string(field.name).c_str());
  tooltip(std::string(field.help) + "\ndefault: " + std::string(field.unset) +
          (by_others ? "\nset by the plan, the mode, shadows or reflections in the panel Drawing" : ""));
  ImGui::TableNextColumn();
  ImGui::BeginDisabled(by_others);
  ImGui::SetNextItemWidth(-1.6f * ImGui::GetFrameHeight());
  if (field.kind == Field::Kind::flag) {
    edit_flag(row);
  } else if (!row.choices.empty()) {
    edit_choice(row);
  } else {
    edit_number(row);
  }
  ImGui::EndDisabled();
  if (!given) return;
  ImGui::SameLine();
  if (ImGui::SmallButton("x")) field.copy(Settings{}, settings);
  tooltip("back to: " + std::string(field.unset));
}

}  // namespace

void draw_all_settings(Model& model, float) {
  if (!ImGui::BeginTable("settings", 2)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  const Settings wanted = wanted_settings(model.settings);
  for (const Field& field : settings_table()) {
    const std::string text = field.text(field.given(wanted) ? wanted : model.drawn);
    ImGui::PushID(field.name.data());
    draw_row({field, model, text, field_choices(field, model.settings)}, wanted);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

}  // namespace pinocchio::app
