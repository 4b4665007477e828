// A glTF file that is being written: its JSON, and the one buffer that its accessors lie in.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/gltf/format/constants.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

struct GltfData {
  using Json = nlohmann::ordered_json;

  Json json;
  std::string binary;

  int add_view(std::string_view bytes) {
    binary.append((4 - binary.size() % 4) % 4, '\0');  // accessors are aligned to 4 bytes
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    binary.append(bytes);
    return as_int(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int add_accessor(std::span<const T> elements, int component_type, const char* type) {
    const int view = add_view({reinterpret_cast<const char*>(elements.data()), elements.size_bytes()});
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", elements.size()},
                                 {"type", type}});
    return as_int(json["accessors"].size()) - 1;
  }

  // The last accessor's bounds, which the specification requires of positions and times.
  void add_bounds(const Json& least, const Json& most) {
    json["accessors"].back()["min"] = least;
    json["accessors"].back()["max"] = most;
  }

  // is_root: a node of the scene; else its parent has to list it.
  int add_node(Json node, bool is_root = true) {
    const int index = as_int(json["nodes"].size());
    if (is_root) json["scenes"][0]["nodes"].push_back(index);
    json["nodes"].push_back(std::move(node));
    return index;
  }
};

}  // namespace pinocchio
