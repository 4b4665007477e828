#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/image/tonemap.h"
#include "hybrid/inspect/inspect_pass.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {

// The content of the window's right half.
enum class Split { off, reference, heat_map };

// What can be changed in the window.
struct ViewSettings {
  Settings settings;                                // given, besides the next four
  std::string_view mode = "hybrid", plan = "auto";  // presets in force
  bool shadows = true, reflections = true;
  float exposure_ev = 0.0f;  // stops
  ToneMap tone_map = ToneMap::clip;
  float scale = 1.0f;  // pixels of the picture for one of the window, along a side
  bool vsync = true;
  Layer buffer = Layer::picture;
  int mask_slot = 0;                  // that `buffer` shows
  std::optional<ChannelRange> range;  // of depth and position. Nothing: the scene's
  Split split = Split::off;
  float split_at = 0.5f;   // of the window's width
  bool wireframe = false;  // the edges of visible triangles are drawn over the picture
  bool accumulate = true;  // a still camera gathers samples
  bool overlay = true;

  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

// Limits of what the controls set.
inline constexpr float kLeastScale = 0.125f, kMostScale = 2.0f;
inline constexpr int kMostExposure = 16;  // stops, either way

// The settings, with presets and switches applied.
[[nodiscard]] Settings wanted_settings(const ViewSettings& settings);

// The value in force of an option (mode, design or plan); sets another one.
[[nodiscard]] std::string_view preset_of(std::string_view option, const ViewSettings& settings);
void choose_preset(std::string_view option, std::string_view value, ViewSettings& settings);
// Applies the preset to `covered` where it adds settings, and only such that `settings` have.
bool add_preset(const Preset& preset, const Settings& settings, Settings& covered);

// One value of a preset's option or of a field, and the rule that it would break. Null: none.
struct Choice {
  std::string_view text, help{};
  const Rule* broken = nullptr;
};
[[nodiscard]] std::vector<Choice> preset_choices(std::string_view option, const ViewSettings& settings);
[[nodiscard]] std::vector<Choice> field_choices(const Field& field, const ViewSettings& settings);

// Changes to the next value that breaks no rule. Where all do, returns the rule that the next one breaks.
const Rule* next_preset(std::string_view option, ViewSettings& settings);
const Rule* next_exchange(ViewSettings& settings);

// The next of an enumeration's first `count` values.
template <class Enum>
[[nodiscard]] Enum next(Enum value, int count) {
  return static_cast<Enum>((as_int(value) + 1) % count);
}
// Changes to the next buffer view; the mask has one view for each slot.
void next_buffer(ViewSettings& settings, int mask_slots);

// The same settings with values within their limits. What presets and switches can express is moved into
// them, so that it can be changed there.
[[nodiscard]] ViewSettings possible(ViewSettings settings);

}  // namespace pinocchio::app
