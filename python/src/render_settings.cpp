#include "python/src/render_settings.h"

#include <algorithm>
#include <array>

namespace pinocchio::python {
namespace {

// A field that has another name in Python, because an array of the picture, or something close to one, has
// its own.
struct Renamed {
  std::string_view field, python, why;
};
constexpr std::array kRenamed{
    Renamed{"depth", "bounces",
            "depth is an array of the picture; the setting for the most bounces is 'bounces'"},
    Renamed{"normals", "send_normals",
            "normals would be taken for the array 'normal', which each picture has; the setting that sends "
            "normals to "
            "the CPU is 'send_normals'"},
    Renamed{"reflection", "reflection_format",
            "reflection is an array of the picture; the setting for how that light travels is "
            "'reflection_format'"},
};

std::string_view python_name(const Field& field) {
  for (const Renamed& row : kRenamed)
    if (row.field == field.name) return row.python;
  return field.name;
}

const Field& field_of(const std::string& name) {
  for (const Renamed& row : kRenamed) {
    if (name == row.field) throw Error(std::string(row.why));
    if (name == row.python) return *find_field(row.field);
  }
  if (const Field* const found = find_field(name)) return *found;
  throw Error("there is no setting '" + name + "'; help(pinocchio_renderer.Engine.render) lists them");
}

std::string text_of(nb::handle value) {
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value) ? "true" : "false";
  return nb::cast<std::string>(nb::str(value));
}

bool is_bool(nb::handle value) {
  return nb::isinstance<nb::bool_>(value) ||
         text_of(value.type().attr("__name__")).starts_with("bool");  // NumPy's
}

// A colour may be a sequence of numbers; True stands for the option without a value, False for "off".
std::string text_of_text(const Field& field, nb::handle value, const std::string& named) {
  if (is_bool(value)) {
    if (field.alone.empty()) throw Error(named + "; it is " + field.domain());
    return std::string(nb::cast<bool>(nb::bool_(nb::borrow(value))) ? field.alone : field.examples.front());
  }
  if (nb::isinstance<nb::str>(value) || !PySequence_Check(value.ptr())) return text_of(value);
  std::string text;
  for (const nb::handle item : nb::borrow<nb::sequence>(value)) {
    try {
      text += (text.empty() ? "" : ",") + std::string(nb::str(nb::float_(item)).c_str());
    } catch (const nb::python_error&) {  // it is no number
      throw Error(named + "; it is " + field.domain());
    }
  }
  return text;
}

// The value as text. A number in quotes is no number, and True is none either.
std::string text_of(const Field& field, nb::handle value) {
  const std::string named = std::string(python_name(field)) + " is " + nb::repr(value).c_str();
  if (field.kind == Field::Kind::text) return text_of_text(field, value, named);
  const bool takes_text = field.kind == Field::Kind::choice;
  if (field.kind == Field::Kind::flag) {
    if (!is_bool(value)) throw Error(named + "; it is True or False");
    return nb::cast<bool>(nb::bool_(nb::borrow(value))) ? "true" : "false";
  }
  if (is_bool(value) || (!takes_text && !PyNumber_Check(value.ptr())))
    throw Error(named + "; it is " + field.domain());
  return text_of(value);
}

bool is_preset(std::string_view option) {
  return std::ranges::any_of(presets(), [&](const Preset& p) { return p.option == option; });
}

std::string values_of(std::string_view option) {
  std::string values;
  for (const Preset& p : presets())
    if (p.option == option) values += (values.empty() ? "" : ", ") + std::string(p.value);
  return values;
}

std::string line_of(const Field& field) {
  return std::string(python_name(field)) + ": " + std::string(field.help) + " (" + field.domain() +
         "; default: " + std::string(field.unset) + ")\n";
}

}  // namespace

Settings settings_of(const nb::kwargs& arguments, int threads) {
  Settings settings;
  if (!arguments.contains("mode")) apply_preset("mode", "raytrace", settings);
  for (const auto& [key, value] : arguments) {
    const std::string option = nb::cast<std::string>(key);
    if (is_preset(option) && !apply_preset(option, text_of(value), settings))
      throw Error(option + " is " + text_of(value) + "; it is one of " + values_of(option));
  }
  if (threads > 0) settings.threads = threads;
  for (const auto& [key, value] : arguments) {
    const std::string name = nb::cast<std::string>(key);
    if (is_preset(name)) continue;
    const Field& field = field_of(name);
    const std::string text = text_of(field, value);
    if (!field.take(text, settings))
      throw Error(std::string(python_name(field)) + " is " + text + "; it is " + field.domain());
  }
  return settings;
}

std::string settings_help() {
  const auto is_transport = [](const Field& f) { return f.group == Field::Group::exchange; };
  std::string text;
  // What a picture needs first, in this order; then the others as the table has them.
  constexpr std::array<std::string_view, 4> kFirst{"spp", "depth", "indirect", "seed"};
  for (const std::string_view name : kFirst) text += line_of(*find_field(name));
  for (const Field& f : settings_table())
    if (!is_transport(f) && std::ranges::find(kFirst, f.name) == kFirst.end()) text += line_of(f);
  text += "\nWho draws, and what travels between CPU and GPU:\n\n";
  for (const Preset& p : presets())
    text += std::string(p.option) + "='" + std::string(p.value) + "': " + std::string(p.help) + "\n";
  for (const Field& f : settings_table())
    if (is_transport(f)) text += line_of(f);
  return text;
}

}  // namespace pinocchio::python
