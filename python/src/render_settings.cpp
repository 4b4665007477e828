#include "python/src/render_settings.h"

#include <algorithm>

namespace pinocchio::python {
namespace {

std::string text_of(nb::handle value) {
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value) ? "true" : "false";
  return nb::cast<std::string>(nb::str(value));
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
    if (!find_field(name))
      throw Error("there is no setting '" + name + "'; help(pinocchio_renderer.Engine.render) lists them");
    (void)value_or_throw(set(settings, name, text_of(value)).map([] { return true; }));
  }
  return settings;
}

std::string settings_help() {
  std::string text;
  for (const Preset& p : presets())
    text += std::string(p.option) + "='" + std::string(p.value) + "': " + std::string(p.help) + "\n";
  for (const Field& f : settings_table())
    text += std::string(f.name) + ": " + std::string(f.help) + " (" + f.domain() +
            "; default: " + std::string(f.unset) + ")\n";
  return text;
}

}  // namespace pinocchio::python
