#include "core/output/aovs.h"

#include <sstream>

namespace pinocchio {

Expected<AovSet> parse_aovs(const std::string& text) {
  static const AovSet kAll{"Z", "P", "N", "Albedo", "id", "shadow", "reflection"};
  if (text == "all") return kAll;
  AovSet aovs;
  if (text == "none") return aovs;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    const std::string layer = name.substr(0, name.find('.'));
    if (!kAll.count(layer))
      return Unexpected(
          InputError{{},
                     0,
                     "'" + name + "' is not a layer",
                     "choose from Z, P, N, Albedo, id, shadow, reflection, or say all or none"});
    aovs.insert(layer);
  }
  return aovs;
}

}  // namespace pinocchio
