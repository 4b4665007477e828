// A small glTF that moves.
#pragma once

#include "tests/support/gltf.h"

namespace pinocchio {

// triangle_json() with numbers behind its own; each array of them gets an accessor.
class Moving {
 public:
  Json json = triangle_json();

  int floats(const std::vector<float>& numbers, const char* type) {
    const int width = type == std::string("SCALAR") ? 1
                      : type == std::string("VEC3") ? 3
                      : type == std::string("VEC4") ? 4
                                                    : 16;
    return add(numbers, type, 5126, numbers.size() / static_cast<std::size_t>(width));
  }
  int bytes(const std::vector<std::uint8_t>& numbers, bool normalized) {
    const int accessor = add(numbers, "VEC4", 5121, numbers.size() / 4);
    json["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = normalized;
    return accessor;
  }
  template <class T>
  int add(const std::vector<T>& numbers, const char* type, int component_type, std::size_t count) {
    const std::size_t size = numbers.size() * sizeof(T), offset = json["buffers"][0]["byteLength"];
    {
      std::ofstream out(own_file("test.bin"), std::ios::binary | std::ios::app);
      out.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(size));
      out.write("\0\0\0", static_cast<std::streamsize>((4 - size % 4) % 4));
    }
    json["buffers"][0]["byteLength"] = offset + (size + 3) / 4 * 4;
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  void animate(int node, const char* path, const std::vector<float>& times, int output,
               const char* interpolation = "LINEAR", std::size_t animation = 0) {
    Json& to = json["animations"][animation];
    to["samplers"].push_back(
        {{"input", floats(times, "SCALAR")}, {"output", output}, {"interpolation", interpolation}});
    to["channels"].push_back(
        {{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
};

}  // namespace pinocchio
