// The panel All settings: for each its name, its value, and a button that goes back to the default.
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

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

// A number or a text. The value counts after Enter, so that no tree is built for every digit.
void edit_number(const Row& row) {
  std::array<char, 64> text{};
  row.text.copy(text.data(), text.size() - 1);
  const ImGuiInputTextFlags any =
      row.field.kind == Field::Kind::text ? 0 : ImGuiInputTextFlags_CharsScientific;
  if (ImGui::InputText("##number", text.data(), text.size(), any | ImGuiInputTextFlags_EnterReturnsTrue))
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
  if (given) {
    ImGui::SameLine();
    if (ImGui::SmallButton("x")) field.copy(Settings{}, settings);
    tooltip("back to: " + std::string(field.unset));
  }
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(style.Colors[ImGuiCol_TextDisabled], "%s", std::string(field.unset).c_str());
  tooltip("default: " + std::string(field.unset));
}

// The settings of some groups under one name.
struct Groups {
  const char* name;
  Field::Group first, last;
};
constexpr Groups kGroups[]{{"Samples", Field::Group::samples, Field::Group::samples},
                           {"Light", Field::Group::light, Field::Group::rays},
                           {"Between CPU and GPU", Field::Group::exchange, Field::Group::exchange},
                           {"Tree and machine", Field::Group::tree, Field::Group::machine}};

// Whether name, help or value have the words that are searched for.
bool is_found(const Row& row, const std::string& search) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  const std::string all = std::string(row.field.name) + " " + std::string(row.field.help) + " " + row.text;
  return lower(all).find(lower(search)) != std::string::npos;
}

void draw_search(Model& model) {
  std::array<char, 64> text{};
  model.settings_search.copy(text.data(), text.size() - 1);
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##search", "search", text.data(), text.size()))
    model.settings_search = text.data();
  tooltip("a word of a setting's name, help or value");
}

void draw_groups(const Groups& groups, Model& model, const Settings& wanted) {
  bool is_first = true;
  for (const Field& field : settings_table()) {
    if (field.group < groups.first || field.group > groups.last) continue;
    const Row row{field, model, field.text(field.given(wanted) ? wanted : model.drawn),
                  field_choices(field, model.settings)};
    if (!is_found(row, model.settings_search)) continue;
    if (std::exchange(is_first, false)) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(kAccent, "%s", groups.name);
    }
    ImGui::PushID(field.name.data());
    draw_row(row, wanted);
    ImGui::PopID();
  }
}

}  // namespace

void draw_all_settings(Model& model, float) {
  draw_search(model);
  if (!ImGui::BeginTable("settings", 3)) return;
  ImGui::TableSetupColumn("setting", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("default", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  const Settings wanted = wanted_settings(model.settings);
  for (const Groups& groups : kGroups) draw_groups(groups, model, wanted);
  ImGui::EndTable();
}

}  // namespace pinocchio::app
