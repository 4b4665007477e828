// The parts of a scene that can be moved.
#include <pinocchio/animation.h>
#include <pinocchio/extract.h>
#include <pinocchio/nodes.h>

#include <nanobind/stl/variant.h>
#include <algorithm>
#include <set>

#include "pinocchio/conversion.h"
#include "python/src/scene/scene.h"
#include "python/src/support/interrupt.h"

namespace pinocchio::python {
namespace {

// A scene is copied (cheaply) before it is read without the GIL, because other threads may change it.
PyScene with_transforms(const PyScene& self, const Dict& transforms) {
  const Scene scene = self.now();
  NodeNumbers numbers(scene);
  const std::vector<NodeTransform> moves = transforms_of(numbers, transforms);
  return PyScene(value_or_throw(without_gil([&](Progress*) { return posed(scene, moves); })));
}

}  // namespace

std::vector<std::string> node_names(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.nodes) return names;
  std::set<std::string> taken;
  for (const Node& node : scene.nodes->nodes) taken.insert(node.name);
  std::set<std::string> used;
  for (std::size_t i = 0; i < scene.nodes->nodes.size(); ++i) {
    std::string name = scene.nodes->nodes[i].name;
    if (name.empty() || used.contains(name)) {
      name += "#" + std::to_string(i);
      while (taken.contains(name) || used.contains(name)) name += "#";
    }
    used.insert(name);
    names.push_back(std::move(name));
  }
  return names;
}

int NodeNumbers::of(const std::variant<int, std::string>& name) {
  if (!scene_.nodes)
    throw Error("the scene has no nodes to move; load a glTF file, or combine scenes (assemble)");
  if (std::holds_alternative<int>(name)) return std::get<int>(name);
  if (by_name_.empty()) {
    const std::vector<std::string> names = node_names(scene_);
    for (std::size_t n = 0; n < names.size(); ++n) by_name_.emplace(names[n], as_int(n));
  }
  const auto found = by_name_.find(std::get<std::string>(name));
  if (found != by_name_.end()) return found->second;
  throw Error("there is no node '" + std::get<std::string>(name) + "'; Scene.nodes lists them");
}

std::vector<NodeTransform> transforms_of(NodeNumbers& numbers, const Dict& transforms) {
  std::vector<NodeTransform> moves;
  for (const auto& [key, matrix] : transforms.read("transforms")) {
    const std::string shown_key = nb::repr(key).c_str();
    std::variant<int, std::string> node;
    if (!nb::try_cast(key, node))
      throw Error("transforms names " + shown_key + "; give a node's name or index");
    moves.push_back({numbers.of(node), Matrix{nb::borrow(matrix)}.read("the transform of " + shown_key)});
  }
  return moves;
}

void bind_nodes(nb::class_<PyScene>& bound) {
  bound
      .def_prop_ro(
          "nodes", [](const PyScene& s) { return node_names(s.scene); },
          "The names of the parts that can be moved. The index in the list is the number in `objects`. Names "
          "differ: "
          "node 7\n"
          "is '#7' if it has no name, and 'wheel#7' if an earlier node is called 'wheel'.")
      .def_prop_ro(
          "node_parents",
          [](const PyScene& s) {
            std::vector<std::int32_t> parents;
            if (s.scene.nodes)
              for (const Node& node : s.scene.nodes->nodes) parents.push_back(node.parent);
            const std::size_t n = parents.size();
            return array_that_owns<std::int32_t>(std::move(parents), {n});
          },
          nb::rv_policy::reference, "(n,) int32: the index of each node's parent, -1 for none.")
      .def_prop_ro(
          "node_transforms",
          [](const PyScene& s) {
            std::vector<glm::mat4> rows;
            if (s.scene.nodes)
              for (const Node& node : s.scene.nodes->nodes) rows.push_back(glm::transpose(node.local));
            const std::size_t n = rows.size();
            return array_that_owns<float>(std::move(rows), {n, 4, 4});
          },
          nb::rv_policy::reference,
          "(n, 4, 4) float32: the matrix from each node to its parent now, as `posed` takes it.")
      .def_prop_ro(
          "triangle_nodes",
          [](const PyScene& s) {
            std::vector<std::uint32_t> nodes(s.scene.mesh->triangles.size());
            for (std::size_t t = 0; t < nodes.size(); ++t) nodes[t] = object_of(s.scene, as_uint32(t));
            const std::size_t n = nodes.size();
            return array_that_owns<std::uint32_t>(std::move(nodes), {n});
          },
          nb::rv_policy::reference,
          "(m,) uint32: the index in `nodes` of each triangle's node, 0 if the scene has no nodes. "
          "triangle_nodes[ids] is\n"
          "`objects`.")
      .def(
          "camera", [](const PyScene& s) { return camera_for_whole_scene(s.now()); },
          "A camera that sees the whole scene.")
      .def("posed", &with_transforms, "transforms"_a,
           nb::sig("def posed(self, transforms: collections.abc.Mapping[str, numpy.typing.ArrayLike] | "
                   "collections.abc.Mapping[int, numpy.typing.ArrayLike]) -> Scene"),
           "The scene with nodes and their children moved.\n"
           "transforms: {name or index: 4x4 matrix from the node to its parent}.\n"
           "Materials, triangles and their ids stay. Lights and cameras move with their nodes.\n"
           "Raises Error if there is no such node, or if a matrix gives numbers that are not finite.")
      .def(
          "only",
          [](const PyScene& self, const std::vector<std::variant<int, std::string>>& nodes,
             bool children) -> std::optional<PyScene> {
            const Scene scene = self.now();
            std::vector<int> numbers;
            NodeNumbers all(scene);
            for (const auto& node : nodes) numbers.push_back(all.of(node));
            if (!scene.nodes) return std::nullopt;
            const auto below = [&](int node) {
              for (; children && node >= 0; node = scene.nodes->nodes[as_size(node)].parent)
                if (std::ranges::count(numbers, node) > 0) return true;
              return std::ranges::count(numbers, node) > 0;
            };
            bool any = false;
            for (std::size_t n = 0; n < scene.nodes->nodes.size(); ++n)
              any = any || (scene.nodes->nodes[n].triangles > 0 && below(as_int(n)));
            const auto count = as_int(scene.nodes->nodes.size());
            const bool known = std::ranges::all_of(numbers, [&](int n) { return n >= 0 && n < count; });
            if (known && !any) return std::nullopt;
            return PyScene(
                value_or_throw(without_gil([&](Progress*) { return extracted(scene, numbers, children); })));
          },
          "nodes"_a, "children"_a = true,
          nb::sig(
              "def only(self, nodes: collections.abc.Sequence[int | str], children: bool = True) -> Scene "
              "| None"),
          "A scene of these nodes' triangles alone, where they are now, without nodes. None: they have no "
          "triangles.\n"
          "nodes: names or indices in `nodes`. children: and all nodes below them.\n"
          "Raises Error if there is no such node.")
      .def_prop_ro(
          "duration", [](const PyScene& s) { return duration_s(s.scene); },
          "The duration of the scene's animation, in seconds. 0: it has none.")
      .def(
          "at_time",
          [](const PyScene& self, double seconds) {
            const Scene scene = self.now();
            return PyScene(value_or_throw(without_gil([&](Progress*) { return at_time(scene, seconds); })));
          },
          "seconds"_a,
          "The scene at a time of its animation: its nodes, skins and morph targets, with the lights and "
          "cameras of nodes.\n"
          "seconds: before the first key and after the last one, the scene does not move.\n"
          "Triangles and their ids stay.\n"
          "Raises Error if the time is not finite.");
}

}  // namespace pinocchio::python
