#include "app/window/settings.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

constexpr float kScaleStep = 1.25f, kExposureStep = 0.5f;

// The next of an enumeration's first `count` values.
template <class Enum>
Enum next(Enum value, int count) {
  return static_cast<Enum>((static_cast<int>(value) + 1) % count);
}

void toggle(bool& setting) {
  setting = !setting;
}

// Steps of the scale meet whole size exactly.
float near_one(float scale) {
  return scale > 0.95f && scale < 1.05f ? 1.0f : scale;
}

// What the preset sets is open again.
void leave(const Preset& preset, Settings& settings) {
  Settings touched;
  preset.apply(touched);
  for (const Field& field : settings_table())
    if (field.given(touched)) field.copy(Settings{}, settings);
}

// Takes the preset that holds, if one does, out of the settings.
void take_preset(std::string_view option, ViewSettings& s) {
  for (const Preset& preset : presets()) {
    Settings said;
    said.composite = s.settings.composite;  // decides what slides are
    if (preset.option != option || !say(preset, s.settings, said)) continue;
    leave(preset, s.settings);
    choose_preset(option, preset.value, s);
  }
}

// Takes a setting that is given as `off` out.
template <class T, class Off>
void take_switch(Setting<T>& setting, Off off, const Setting<T>& open, bool& on) {
  if (!setting.given || setting.value != off) return;
  setting = open;
  on = false;
}

// The first of the values after the one in force that breaks no rule.
template <class Values>
const Rule* next_allowed(const Values& values, std::string_view now, ViewSettings& s, auto choose) {
  const Rule* first = nullptr;
  const auto at = static_cast<std::size_t>(std::ranges::find(values, now) - std::begin(values));
  for (std::size_t i = 1; i < values.size(); ++i) {
    ViewSettings changed = s;
    choose(values[(at + i) % values.size()], changed);
    const Rule* const rule = broken_rule(wanted_settings(changed));
    if (!rule) {
      s = changed;
      return nullptr;
    }
    if (!first) first = rule;
  }
  return first;
}

const Rule* next_preset(std::string_view option, ViewSettings& s) {
  std::vector<std::string_view> values;
  for (const Preset& preset : presets())
    if (preset.option == option) values.push_back(preset.value);
  return next_allowed(values, preset_of(option, s), s, [&](std::string_view value, ViewSettings& changed) {
    choose_preset(option, value, changed);
  });
}

const Rule* next_exchange(ViewSettings& s) {
  const Field& field = *find_field("exchange");
  return next_allowed(field.choices, field.text(wanted_settings(s)), s,
                      [&](std::string_view value, ViewSettings& changed) { field.take(value, changed.settings); });
}

void add_bounces(int more, Settings& s) {
  s.depth = std::clamp(s.depth + more, 0, kMostBounces);
}

}  // namespace

bool say(const Preset& preset, const Settings& settings, Settings& said) {
  Settings after = said;
  preset.apply(after);
  const auto adds_to = [&](const Settings& s) {
    return [&](const Field& f) { return f.given(after) && !(f.given(s) && f.same(after, s)); };
  };
  if (std::ranges::any_of(settings_table(), adds_to(settings))) return false;
  if (std::ranges::none_of(settings_table(), adds_to(said))) return false;
  said = after;
  return true;
}

Settings wanted_settings(const ViewSettings& settings) {
  Settings s = settings.settings;
  s.exchange.fill(Exchange::pipelined);
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

const Rule* change_setting(Action action, ViewSettings& s) {
  switch (action) {
    case Action::next_mode:
      return next_preset("mode", s);
    case Action::next_design:
      return next_preset("design", s);
    case Action::next_exchange:
      return next_exchange(s);
    case Action::next_plan:
      return next_preset("plan", s);
    case Action::shadows:
      toggle(s.shadows);
      break;
    case Action::reflections:
      toggle(s.reflections);
      break;
    case Action::deeper:
      add_bounces(1, s.settings);
      break;
    case Action::shallower:
      add_bounces(-1, s.settings);
      break;
    case Action::brighter:
      s.exposure_ev += kExposureStep;
      break;
    case Action::darker:
      s.exposure_ev -= kExposureStep;
      break;
    case Action::finer:
      s.scale = near_one(s.scale * kScaleStep);
      break;
    case Action::coarser:
      s.scale = near_one(s.scale / kScaleStep);
      break;
    case Action::accumulate:
      toggle(s.accumulate);
      break;
    case Action::split:
      s.split = next(s.split, 3);
      break;
    case Action::vsync:
      toggle(s.vsync);
      break;
    case Action::overlay:
      toggle(s.overlay);
      break;
    case Action::help:
      toggle(s.help);
      break;
    default:
      break;
  }
  return nullptr;
}

void next_buffer(ViewSettings& s, int mask_slots) {
  if (s.buffer == BufferView::mask && s.mask_slot + 1 < mask_slots) {
    ++s.mask_slot;
    return;
  }
  s.mask_slot = 0;
  s.buffer = next(s.buffer, static_cast<int>(kBufferViewNames.size()));
}

ViewSettings possible(ViewSettings settings) {
  take_preset("mode", settings);
  take_preset("plan", settings);
  take_switch(settings.settings.mask_bits, 0, Settings{}.mask_bits, settings.shadows);
  take_switch(settings.settings.reflection, ReflectionFormat::none, Settings{}.reflection, settings.reflections);
  settings.scale = std::clamp(settings.scale, kLeastScale, kMostScale);
  settings.mask_slot = std::max(settings.mask_slot, 0);
  settings.split_at = std::clamp(settings.split_at, 0.05f, 0.95f);
  settings.exposure_ev = std::clamp(settings.exposure_ev, -kMostExposure, kMostExposure);
  return settings;
}

}  // namespace pinocchio::app
