// What a glTF file that is being written holds: its JSON, and the one buffer that its accessors lie in.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pinocchio {

inline constexpr int kGltfUnsignedShort = 5123, kGltfUnsignedInt = 5125,
                     kGltfFloat = 5126;  // component types

struct GltfData {
  using Json = nlohmann::ordered_json;

  Json json;
  std::string binary;

  int add_view(std::string_view bytes) {
    binary.append((4 - binary.size() % 4) % 4, '\0');  // numbers lie where they may
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    binary.append(bytes);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int add_accessor(std::span<const T> elements, int component_type, const char* type) {
    const int view = add_view({reinterpret_cast<const char*>(elements.data()), elements.size_bytes()});
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", elements.size()},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  // Of the last accessor; the specification wants them of positions and of times.
  void add_bounds(const Json& least, const Json& most) {
    json["accessors"].back()["min"] = least;
    json["accessors"].back()["max"] = most;
  }

  // Into the scene, or below a parent that calls it its child itself.
  int add_node(Json node, bool is_root = true) {
    const int index = static_cast<int>(json["nodes"].size());
    if (is_root) json["scenes"][0]["nodes"].push_back(index);
    json["nodes"].push_back(std::move(node));
    return index;
  }
};

}  // namespace pinocchio
