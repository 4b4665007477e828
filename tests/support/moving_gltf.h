// A small glTF that moves.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "pinocchio/animation.h"
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

// Two joints: vertex 1 follows the second alone, vertex 2 both by halves. The skinned node's own place does
// not count.
inline Moving skinned() {
  Moving m;
  m.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                     {{"translation", {1, 0, 0}}, {"children", {2}}},
                     {{"translation", {0, 1, 0}}}};
  m.json["scenes"][0]["nodes"] = {0, 1};
  const glm::mat4 inverse0 = glm::translate(glm::mat4(1.0f), {-1, 0, 0}),
                  inverse1 = glm::translate(glm::mat4(1.0f), {-1, -1, 0});
  std::vector<float> matrices(&inverse0[0][0], &inverse0[0][0] + 16);
  matrices.insert(matrices.end(), &inverse1[0][0], &inverse1[0][0] + 16);
  m.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", m.floats(matrices, "MAT4")}}};
  m.primitive()["attributes"]["JOINTS_0"] = m.bytes({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, false);
  m.primitive()["attributes"]["WEIGHTS_0"] =
      m.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0}, "VEC4");
  return m;
}

// A mesh with two morph targets.
inline Moving morphed() {
  Moving m;
  m.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", m.floats({0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}},
      {{"POSITION", m.floats({0, 2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  m.json["meshes"][0]["weights"] = {0.5, 0.25};
  return m;
}

inline Scene at(const Scene& scene, double seconds) {
  Expected<Scene> moved = at_time(scene, seconds);
  EXPECT_TRUE(moved) << moved.error().message();
  return moved ? std::move(*moved) : Scene{};
}

inline void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 2e-6f) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

}  // namespace pinocchio
