#include "core/output/aovs.h"

#include <algorithm>
#include <sstream>

#include "pinocchio/frame_arrays.h"

namespace pinocchio {

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
      return !of.exr.name.empty() && !name.empty() &&
             (of.exr.name == name || std::ranges::count(of.exr.channels, name) > 0);
    });
    if (row == kLayers.end())
      return Unexpected(InputError{
          {}, 0, "'" + name + "' is not a layer", "choose from " + aov_names() + ", or say all or none"});
    aovs.emplace(row->exr.name);
  }
  return aovs;
}

}  // namespace pinocchio
