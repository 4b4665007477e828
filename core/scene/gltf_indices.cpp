#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scene/gltf_features.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// Where a file names things by their number, and the array in which they are. '*': any of an array or
// object.
struct Reference {
  std::string_view at, in;
  bool refused = false;  // too great a number is an error where what names it is used
  bool floats = false;   // 3.0 is read as 3
};

constexpr Reference kReferences[] = {
    {"scene", "scenes"},
    {"nodes/*/mesh", "meshes", true},
    {"nodes/*/skin", "skins", true},
    {"nodes/*/camera", "cameras"},
    {"meshes/*/primitives/*/attributes/*", "accessors", true},
    {"meshes/*/primitives/*/targets/*/*", "accessors", true},
    {"meshes/*/primitives/*/indices", "accessors", true, true},
    {"meshes/*/primitives/*/material", "materials", true},
    {"accessors/*/bufferView", "bufferViews", true},
    {"bufferViews/*/buffer", "buffers", true},
    {"images/*/bufferView", "bufferViews"},
    {"skins/*/inverseBindMatrices", "accessors", true},
    {"textures/*/sampler", "samplers"},
};

class IndexAudit {
 public:
  IndexAudit(const std::filesystem::path& file, const Json& gltf, Warnings& warnings)
      : file_(file.string()), gltf_(gltf), warnings_(warnings) {}

  void look(const Reference& reference) {
    const auto items = gltf_.find(reference.in);
    count_ = items != gltf_.end() && items->is_array() ? items->size() : 0;
    look(gltf_, reference.at, reference);
  }

 private:
  void look(const Json& json, std::string_view path, const Reference& reference) {
    if (path.empty()) return check(json, reference);
    const std::string_view name = path.substr(0, path.find('/'));
    const std::string_view rest = path.substr(std::min(name.size() + 1, path.size()));
    if (!json.is_structured()) return;
    if (name == "*") {
      for (const auto& item : json.items()) step(item.key(), item.value(), rest, reference);
    } else if (const auto member = json.find(name); member != json.end()) {
      step(std::string(name), *member, rest, reference);
    }
  }

  void step(std::string name, const Json& json, std::string_view path, const Reference& reference) {
    within_.push_back(std::move(name));
    look(json, path, reference);
    within_.pop_back();
  }

  void check(const Json& index, const Reference& reference) {
    const bool is_index = index.is_number_unsigned() || (reference.floats && index.is_number_float());
    const bool too_great = is_index && index.get<double>() >= static_cast<double>(count_);
    if (is_index && index.get<double>() >= 0.0 && !too_great) return;
    std::string where;
    for (const std::string& name : within_) where += (where.empty() ? "" : ".") + name;
    warnings_.add({file_, where,
                   "names " + index.dump(-1, ' ', true).substr(0, 40) + " of " + std::string(reference.in) +
                       ", there are " + std::to_string(count_),
                   too_great && reference.refused ? "nothing can be made of what names it"
                                                  : "it counts as if it named none"});
  }

  std::string file_;
  const Json& gltf_;
  Warnings& warnings_;
  std::size_t count_ = 0;            // of what is named
  std::vector<std::string> within_;  // the way to what is looked at
};

}  // namespace

void add_lost_gltf_references(const std::filesystem::path& file, const Json& gltf, Warnings& warnings) {
  IndexAudit audit(file, gltf, warnings);
  for (const Reference& reference : kReferences) audit.look(reference);
}

}  // namespace pinocchio
