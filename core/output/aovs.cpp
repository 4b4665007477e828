#include "core/output/aovs.h"

#include <algorithm>
#include <sstream>

#include "pinocchio/frame_arrays.h"

namespace pinocchio {
namespace {

// A channel of the layer; a mask's may have a number ("shadow.mask1").
bool is_channel_of(const LayerRow& row, const std::string& name) {
  const auto has = [&](const std::string& channel) {
    return std::ranges::count(row.exr.channels, channel) > 0;
  };
  if (row.layer != Layer::mask) return has(name);
  return has(name.substr(0, name.find_last_not_of("0123456789") + 1));
}

}  // namespace

std::string aov_names() {
  std::string names;
  for (const LayerRow& row : kLayers)
    if (!row.exr.name.empty()) names += (names.empty() ? "" : ", ") + std::string(row.exr.name);
  return names;
}

Expected<AovSet> parse_aovs(const std::string& text) {
  AovSet aovs;
  if (text == "none") return aovs;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    if (name == "all") {
      for (const LayerRow& row : kLayers)
        if (!row.exr.name.empty() && !row.exr.by_name_only) aovs.emplace(row.exr.name);
      continue;
    }
    const auto* const row = std::ranges::find_if(kLayers, [&](const LayerRow& of) {
      return !of.exr.name.empty() && !name.empty() && (of.exr.name == name || is_channel_of(of, name));
    });
    if (row == kLayers.end())
      return Unexpected(InputError{
          {}, 0, "'" + name + "' is not a layer", "choose from " + aov_names() + ", or say all or none"});
    aovs.emplace(row->exr.name);
  }
  return aovs;
}

}  // namespace pinocchio
