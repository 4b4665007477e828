#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/image/tonemap.h"
#include "hybrid/inspect/inspect_pass.h"

namespace pinocchio::app {

// What the window's right half shows.
enum class Split { off, reference, heat_map };

// What a person at the window can change while it draws.
struct ViewSettings {
  Settings settings;                                // what is given, without what the next four say
  std::string_view mode = "hybrid", plan = "auto";  // presets in force
  bool shadows = true, reflections = true;
  float exposure_ev = 0.0f;  // stops
  ToneMap tone_map = ToneMap::clip;
  float scale = 1.0f;  // pixels drawn for one of the window's, along a side
  bool vsync = true;
  BufferView buffer = BufferView::picture;
  int mask_slot = 0;                  // of the buffer view
  std::optional<ChannelRange> range;  // of depth and position; nothing: as the scene has it
  Split split = Split::off;
  float split_at = 0.5f;   // of the window's width
  bool accumulate = true;  // a still camera gathers samples
  bool overlay = true;

  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

// Limits of what the controls set.
inline constexpr float kLeastScale = 0.125f, kMostScale = 2.0f;
inline constexpr float kMostExposure = 16.0f;  // stops, either way

// What is to be drawn: the settings, and over them presets and switches.
[[nodiscard]] Settings wanted_settings(const ViewSettings& settings);

// The value of the option (mode, design or plan) that is in force, and another one instead.
[[nodiscard]] std::string_view preset_of(std::string_view option, const ViewSettings& settings);
void choose_preset(std::string_view option, std::string_view value, ViewSettings& settings);
// Applies the preset to `said`, where that says more and nothing that `settings` do not say.
bool say(const Preset& preset, const Settings& settings, Settings& said);

// One value of a preset's option or of a field, and the rule that it would break; null: it can be had.
struct Choice {
  std::string_view text, help{};
  const Rule* broken = nullptr;
};
[[nodiscard]] std::vector<Choice> preset_choices(std::string_view option, const ViewSettings& settings);
[[nodiscard]] std::vector<Choice> field_choices(const Field& field, const ViewSettings& settings);

// Takes the next value that breaks no rule; where there is none, the rule that one breaks.
const Rule* next_preset(std::string_view option, ViewSettings& settings);
const Rule* next_exchange(ViewSettings& settings);

// The next of an enumeration's first `count` values.
template <class Enum>
[[nodiscard]] Enum next(Enum value, int count) {
  return static_cast<Enum>((static_cast<int>(value) + 1) % count);
}
// The next of the buffers to look at; of the mask, one of `mask_slots` after the other.
void next_buffer(ViewSettings& settings, int mask_slots);

// The same, with values in their limits; and what presets and switches can say is said by them alone, so that
// they can be left again.
[[nodiscard]] ViewSettings possible(ViewSettings settings);

}  // namespace pinocchio::app
