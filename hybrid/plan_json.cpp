#include "hybrid/plan_json.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

namespace pinocchio {
namespace {

// One setting: its name, how it is written and read. `read` returns false where the value is none.
struct Setting {
  std::string_view name;
  nlohmann::json (*write)(const Plan&);
  bool (*read)(const nlohmann::json&, Plan&);
  std::string_view wanted;
};

template <class Enum, std::size_t N>
bool read_name(const nlohmann::json& json, const std::array<std::string_view, N>& names, Enum& to) {
  if (!json.is_string()) return false;
  const auto found = std::find(names.begin(), names.end(), json.get_ref<const std::string&>());
  if (found == names.end()) return false;
  to = static_cast<Enum>(found - names.begin());
  return true;
}

template <class Enum, std::size_t N>
std::string_view name_of(const std::array<std::string_view, N>& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

bool read_value(const nlohmann::json& json, bool& to) {
  if (!json.is_boolean()) return false;
  to = json.get<bool>();
  return true;
}
bool read_value(const nlohmann::json& json, int& to) {
  if (!json.is_number_integer()) return false;
  const auto value = json.get<long long>();
  if (value < -1'000'000 || value > 1'000'000) return false;
  to = static_cast<int>(value);
  return true;
}
bool read_value(const nlohmann::json& json, float& to) {
  if (!json.is_number()) return false;
  to = json.get<float>();
  return true;
}

template <auto Member>
constexpr Setting setting(std::string_view name, std::string_view wanted) {
  return {name, [](const Plan& plan) { return nlohmann::json(plan.*Member); },
          [](const nlohmann::json& json, Plan& plan) { return read_value(json, plan.*Member); }, wanted};
}

template <auto Member, const auto& Names>
constexpr Setting named(std::string_view name, std::string_view wanted) {
  return {name, [](const Plan& plan) { return nlohmann::json(name_of(Names, plan.*Member)); },
          [](const nlohmann::json& json, Plan& plan) { return read_name(json, Names, plan.*Member); },
          wanted};
}

constexpr std::string_view kWhole = "a whole number", kNumber = "a number", kBool = "true or false";
constexpr std::array kSettings{
    named<&Plan::mode, kModeNames>("mode", "\"hybrid\", \"raytrace\" or \"raster\""),
    setting<&Plan::design>("design", kWhole),
    named<&Plan::primary, kPrimaryNames>("primary", "\"raster\" or \"rays\""),
    setting<&Plan::id_bits>("id_bits", kWhole),
    setting<&Plan::normals>("normals", kBool),
    setting<&Plan::wide>("wide", kBool),
    setting<&Plan::mask_bits>("mask_bits", kWhole),
    setting<&Plan::mask_scale>("mask_scale", kWhole),
    named<&Plan::reflection, kReflectionFormatNames>("reflection",
                                                     "\"none\", \"rgb8\", \"rgb9e5\", \"half\" or \"float\""),
    setting<&Plan::reflection_scale>("reflection_scale", kWhole),
    setting<&Plan::tiles>("tiles", kBool),
    setting<&Plan::depth>("depth", kWhole),
    setting<&Plan::least_contribution>("least_contribution", kNumber),
    setting<&Plan::least_light>("least_light", kNumber),
    setting<&Plan::reuse>("reuse", kBool),
    setting<&Plan::precise>("precise", kBool),
    setting<&Plan::threads>("threads", kWhole),
};

// The line on which `at` is, from 1.
int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n'));
}

// Where the setting stands, from 1; 0: nowhere.
int line_of_setting(const std::string& text, const std::string& name) {
  const std::size_t at = text.find('"' + name + '"');
  return at == std::string::npos ? 0 : line_of(text, at);
}

Expected<Plan> plan_of(const nlohmann::json& json, const std::string& file, const std::string& text) {
  Plan plan;
  for (const auto& [name, value] : json.items()) {
    const auto* const found = std::find_if(kSettings.begin(), kSettings.end(),
                                           [&key = name](const Setting& s) { return s.name == key; });
    if (found == kSettings.end())
      return Unexpected(InputError{file, line_of_setting(text, name), "a plan has no '" + name + "'",
                                   "'pinocchio info SCENE --plan --json' writes one with every setting"});
    if (!found->read(value, plan))
      return Unexpected(InputError{file, line_of_setting(text, name), name + " is " + value.dump(),
                                   "it is " + std::string(found->wanted)});
  }
  return plan;
}

}  // namespace

nlohmann::json to_json(const Plan& plan) {
  nlohmann::json json;
  for (const Setting& setting : kSettings) json[std::string(setting.name)] = setting.write(plan);
  return json;
}

Expected<Plan> load_plan(const std::filesystem::path& file, const Needs& needs) {
  std::ifstream in(file);
  std::error_code ignored;
  if (!in || !std::filesystem::is_regular_file(file, ignored))
    return Unexpected(
        InputError{file.string(), 0, "cannot be read", "--plan takes auto, slides or a plan's file"});
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return Unexpected(InputError{file.string(), line_of(text, error.byte), "is no JSON",
                                 "'pinocchio info SCENE --plan --json' writes a plan"});
  }
  if (json.is_object() && json.contains("plan")) json = nlohmann::json(json["plan"]);
  if (!json.is_object())
    return Unexpected(
        InputError{file.string(), 0, "is no plan", "'pinocchio info SCENE --plan --json' writes one"});
  Expected<Plan> plan = plan_of(json, file.string(), text);
  if (!plan) return plan;
  if (const Expected<void> checked = check_plan(*plan, needs); !checked) {
    InputError error = checked.error();
    error.file = file.string();
    return Unexpected(error);
  }
  return plan;
}

}  // namespace pinocchio
