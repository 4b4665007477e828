#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scene/gltf/format/features.h"
#include "core/scene/gltf/format/json.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// A place of indices, and the array that they are of. '*': any item of an array or object.
struct Reference {
  std::string_view at, in;
  bool refused = false;  // an index that is too large is an error where it is used
};

constexpr Reference kReferences[] = {
    {"scene", "scenes"},
    {"nodes/*/mesh", "meshes", true},
    {"nodes/*/skin", "skins", true},
    {"nodes/*/camera", "cameras"},
    {"meshes/*/primitives/*/attributes/*", "accessors", true},
    {"meshes/*/primitives/*/targets/*/*", "accessors", true},
    {"meshes/*/primitives/*/indices", "accessors", true},
    {"meshes/*/primitives/*/material", "materials", true},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material", "materials", true},
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

  void check(const Reference& reference) {
    const auto items = gltf_.find(reference.in);
    count_ = items != gltf_.end() && items->is_array() ? items->size() : 0;
    walk(gltf_, reference.at, reference);
  }

 private:
  void walk(const Json& json, std::string_view path, const Reference& reference) {
    if (path.empty()) return check_index(json, reference);
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
    walk(json, path, reference);
    within_.pop_back();
  }

  void check_index(const Json& index, const Reference& reference) {
    const std::optional<std::size_t> number = value_of<std::size_t>(index);
    if (number && *number < count_) return;
    std::string where;
    for (const std::string& name : within_) where += (where.empty() ? "" : ".") + name;
    warnings_.add(
        {file_, where,
         "names " + index.dump(-1, ' ', true).substr(0, 40) + " of " + std::string(reference.in) +
             ", there are " + std::to_string(count_),
         number && reference.refused ? "the file cannot be drawn if this is used" : "it is ignored"});
  }

  std::string file_;
  const Json& gltf_;
  Warnings& warnings_;
  std::size_t count_ = 0;            // length of the array that indices are of
  std::vector<std::string> within_;  // keys from the root to the value that is checked
};

}  // namespace

void add_lost_gltf_references(const std::filesystem::path& file, const Json& gltf, Warnings& warnings) {
  IndexAudit audit(file, gltf, warnings);
  for (const Reference& reference : kReferences) audit.check(reference);
}

}  // namespace pinocchio
