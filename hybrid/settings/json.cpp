#include "hybrid/settings/json.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The line of position `at`, from 1.
int line_of(const std::string& text, std::size_t at) {
  return 1 + as_int(std::count(text.begin(),
                               text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n'));
}

// The line of the field, from 1; 0: it is not there.
int line_of_field(const std::string& text, const std::string& name) {
  const std::size_t at = text.find('"' + name + '"');
  return at == std::string::npos ? 0 : line_of(text, at);
}

bool suits(const nlohmann::json& value, Field::Kind kind) {
  switch (kind) {
    case Field::Kind::choice:
      return value.is_string();
    case Field::Kind::whole:
      return value.is_number_integer();
    case Field::Kind::number:
      return value.is_number();
    case Field::Kind::flag:
      return value.is_boolean();
    case Field::Kind::text:
      return value.is_string() || value.is_number();
  }
  return false;
}

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Former fields: mode, design and primary became visibility and composite; precise became an option.
constexpr std::array<const char*, 4> kFormerNames{"design", "primary", "mode", "precise"};

bool take_former(const std::string& name, const std::string& value, Settings& settings) {
  if (name == "precise") return value == "false";
  if (name != "primary") return apply_preset(name, value, settings);
  settings.visibility = value == "rays" ? Processor::cpu : Processor::gpu;
  return value == "rays" || value == "raster";
}

Expected<Settings> settings_of(const nlohmann::json& json, const std::string& file, const std::string& text) {
  Settings settings;
  for (const auto& [name, value] : json.items()) {
    if (std::ranges::find(kFormerNames, name) != kFormerNames.end()) continue;
    const Field* const field = find_field(name);
    if (!field)
      return Unexpected(InputError{file, line_of_field(text, name), "there is no setting '" + name + "'",
                                   "'pinocchio info --settings' lists them"});
    if (!suits(value, field->kind) || !field->take(text_of(value), settings))
      return Unexpected(InputError{file, line_of_field(text, name), name + " is " + value.dump(),
                                   "it is " + field->domain()});
  }
  for (const std::string name : kFormerNames)
    if (json.contains(name) && !take_former(name, text_of(json[name]), settings))
      return Unexpected(
          InputError{file, line_of_field(text, name), name + " is " + json[name].dump(),
                     "write visibility and composite, each \"cpu\" or \"gpu\"; --precise is said "
                     "on the command line"});
  return settings;
}

}  // namespace

nlohmann::json to_json(const Settings& settings, bool with_machine) {
  nlohmann::json json;
  for (const Field& field : settings_table()) {
    if (field.of_machine && !with_machine) continue;
    const std::string text = field.text(settings);
    json[std::string(field.name)] = field.kind == Field::Kind::choice || field.kind == Field::Kind::text
                                        ? nlohmann::json(text)
                                        : nlohmann::json::parse(text);
  }
  return json;
}

Expected<Settings> load_settings(const std::filesystem::path& file) {
  std::error_code ignored;  // checked before it is opened: opening a pipe may never return
  std::ifstream in;
  if (std::filesystem::is_regular_file(file, ignored)) in.open(file);
  if (!in.is_open())
    return Unexpected(
        InputError{file.string(), 0, "cannot be read", "--plan takes auto, slides or a plan's file"});
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return Unexpected(InputError{file.string(), line_of(text, error.byte), "is no JSON",
                                 "'pinocchio info SCENE --plan --json' writes a plan"});
  } catch (const nlohmann::json::out_of_range&) {
    return Unexpected(InputError{file.string(), 0, "has a number that is too large",
                                 "'pinocchio info --settings' says what each setting may be"});
  }
  if (json.is_object() && json.contains("plan")) json = nlohmann::json(json["plan"]);
  if (!json.is_object())
    return Unexpected(
        InputError{file.string(), 0, "is no plan", "'pinocchio info SCENE --plan --json' writes one"});
  return settings_of(json, file.string(), text);
}

}  // namespace pinocchio
