#include "app/window/model/settings.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

// Takes back what the preset sets.
void remove_preset(const Preset& preset, Settings& settings) {
  Settings touched;
  preset.apply(touched);
  for (const Field& field : settings_table())
    if (field.given(touched)) field.copy(Settings{}, settings);
}

// Moves settings that a preset of the option covers into the preset.
void extract_preset(std::string_view option, ViewSettings& s) {
  for (const Preset& preset : presets()) {
    Settings covered;
    covered.composite = s.settings.composite;  // the plan slides depends on it
    if (preset.option != option || !add_preset(preset, s.settings, covered)) continue;
    remove_preset(preset, s.settings);
    choose_preset(option, preset.value, s);
  }
}

// Moves a setting that is given as `off` into the switch.
template <class T, class Off>
void extract_switch(Setting<T>& setting, Off off, const Setting<T>& open, bool& on) {
  if (!setting.given || setting.value != off) return;
  setting = open;
  on = false;
}

// The next choice that breaks no rule. Where all do, the next one.
const Choice& next_of(const std::vector<Choice>& choices, std::string_view now) {
  const std::size_t at = std::ranges::find(choices, now, &Choice::text) - choices.begin();
  for (std::size_t i = 1; i < choices.size(); ++i)
    if (const Choice& choice = choices[(at + i) % choices.size()]; !choice.broken) return choice;
  return choices[(at + 1) % choices.size()];
}

}  // namespace

bool add_preset(const Preset& preset, const Settings& settings, Settings& covered) {
  Settings after = covered;
  preset.apply(after);
  const auto adds_to = [&](const Settings& s) {
    return [&](const Field& f) { return f.given(after) && !(f.given(s) && f.same(after, s)); };
  };
  if (std::ranges::any_of(settings_table(), adds_to(settings))) return false;
  if (std::ranges::none_of(settings_table(), adds_to(covered))) return false;
  covered = after;
  return true;
}

Settings wanted_settings(const ViewSettings& settings) {
  Settings s = settings.settings;
  s.exchange.fill(Exchange::pipelined);
  s.denoise.fill(true);
  apply_preset("mode", settings.mode, s);
  apply_preset("plan", settings.plan, s);
  if (!settings.shadows) s.mask_bits = 0;
  if (!settings.reflections) s.reflection = ReflectionFormat::none;
  return s;
}

std::string_view preset_of(std::string_view option, const ViewSettings& settings) {
  if (option == "design") return settings.settings.composite == Processor::cpu ? "2" : "1";
  return option == "mode" ? settings.mode : settings.plan;
}

void choose_preset(std::string_view option, std::string_view value, ViewSettings& settings) {
  if (option == "mode") {
    settings.mode = value;
  } else if (option == "plan") {
    settings.plan = value;
  } else if (value == "2") {
    apply_preset(option, value, settings.settings);
  } else {
    settings.settings.visibility = Settings{}.visibility;
    settings.settings.composite = Settings{}.composite;
  }
}

std::vector<Choice> preset_choices(std::string_view option, const ViewSettings& settings) {
  std::vector<Choice> choices;
  for (const Preset& preset : presets()) {
    if (preset.option != option) continue;
    ViewSettings changed = settings;
    choose_preset(option, preset.value, changed);
    choices.push_back({preset.value, preset.help, broken_rule(wanted_settings(changed))});
  }
  return choices;
}

std::vector<Choice> field_choices(const Field& field, const ViewSettings& settings) {
  const Settings wanted = wanted_settings(settings);
  std::vector<Choice> choices;
  for (const std::string_view value : field.choices)
    choices.push_back({value, field.help, broken_by(wanted, field.name, value)});
  return choices;
}

const Rule* next_preset(std::string_view option, ViewSettings& s) {
  const std::vector<Choice> choices = preset_choices(option, s);
  const Choice& next = next_of(choices, preset_of(option, s));
  if (!next.broken) choose_preset(option, next.text, s);
  return next.broken;
}

const Rule* next_exchange(ViewSettings& s) {
  const Field& field = *find_field("exchange");
  const std::vector<Choice> choices = field_choices(field, s);
  const Choice& next = next_of(choices, field.text(wanted_settings(s)));
  if (!next.broken) field.take(next.text, s.settings);
  return next.broken;
}

void next_buffer(ViewSettings& s, int mask_slots) {
  if (s.buffer == Layer::mask && s.mask_slot + 1 < mask_slots) {
    ++s.mask_slot;
    return;
  }
  s.mask_slot = 0;
  s.buffer = next(s.buffer, kShownLayers);
}

ViewSettings possible(ViewSettings settings) {
  extract_preset("mode", settings);
  extract_preset("plan", settings);
  extract_switch(settings.settings.mask_bits, 0, Settings{}.mask_bits, settings.shadows);
  extract_switch(settings.settings.reflection, ReflectionFormat::none, Settings{}.reflection,
                 settings.reflections);
  settings.scale = std::clamp(settings.scale, kLeastScale, kMostScale);
  settings.mask_slot = std::max(settings.mask_slot, 0);
  settings.split_at = std::clamp(settings.split_at, 0.05f, 0.95f);
  settings.exposure_ev = std::clamp(settings.exposure_ev, -1.0f * kMostExposure, 1.0f * kMostExposure);
  return settings;
}

}  // namespace pinocchio::app
