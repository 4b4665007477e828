#include "core/output/aovs.h"

#include <sstream>

namespace pinocchio {

namespace {

// Each channel by name, with the layer alone: what may be asked for.
const std::set<std::string>& known_names() {
  static const std::set<std::string> kNames{"Z",           "P",          "P.X",          "P.Y",
                                            "P.Z",         "N",          "N.X",          "N.Y",
                                            "N.Z",         "Albedo",     "Albedo.R",     "Albedo.G",
                                            "Albedo.B",    "id",         "id.triangle",  "shadow",
                                            "shadow.mask", "reflection", "reflection.R", "reflection.G",
                                            "reflection.B"};
  return kNames;
}

}  // namespace

Expected<AovSet> parse_aovs(const std::string& text) {
  static const AovSet kAll{"Z", "P", "N", "Albedo", "id", "shadow", "reflection"};
  if (text == "all") return kAll;
  AovSet aovs;
  if (text == "none") return aovs;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    if (!known_names().count(name))
      return Unexpected(
          InputError{{},
                     0,
                     "'" + name + "' is not a layer",
                     "choose from Z, P, N, Albedo, id, shadow, reflection, or say all or none"});
    aovs.insert(name.substr(0, name.find('.')));
  }
  return aovs;
}

}  // namespace pinocchio
