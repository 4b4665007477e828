#pragma once

#include <pinocchio/nodes.h>
#include <pinocchio/scene.h>

#include <memory>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "python/src/support/convert.h"

namespace pinocchio::python {

// A Scene whose lights and cameras are Python's lists, so that they can be changed in place.
struct PyScene {
  explicit PyScene(Scene from);

  // The scene with the lights and cameras that the lists hold now. The GIL is held. Throws Error.
  [[nodiscard]] Scene now() const;

  Scene scene;  // its own lights and cameras are empty
  nb::list lights, cameras;
};

// A material and its texture.
struct TexturedMaterial {
  Material material;
  std::shared_ptr<const Texture> texture;
};

// The nodes' names: '#7' for node 7 where it has none, 'wheel#7' where an earlier node has its name.
[[nodiscard]] std::vector<std::string> node_names(const Scene& scene);

// Finds a scene's nodes by name or number. The scene must outlive it.
class NodeNumbers {
 public:
  explicit NodeNumbers(const Scene& scene) : scene_(scene) {}

  // A number is not checked. Throws Error.
  [[nodiscard]] int of(const std::variant<int, std::string>& name);

 private:
  const Scene& scene_;
  std::unordered_map<std::string, int> by_name_;  // empty until the first name is looked up
};

// The moves of {name or index: 4x4 matrix from the node to its parent}. Throws Error.
[[nodiscard]] std::vector<NodeTransform> transforms_of(NodeNumbers& numbers, const Dict& transforms);

// Scene's properties and methods of nodes.
void bind_nodes(nb::class_<PyScene>& bound);

}  // namespace pinocchio::python
