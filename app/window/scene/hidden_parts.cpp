#include "app/window/scene/hidden_parts.h"

#include <algorithm>
#include <utility>

#include "pinocchio/conversion.h"

namespace pinocchio::app {

void HiddenParts::begin() {
  const Scene& scene = model_.scene;
  triangles_ = scene.mesh->triangles;
  const auto has_triangles = [](const Node& node) { return node.triangles > 0; };
  model_.parts.are_nodes = scene.nodes && std::ranges::count_if(scene.nodes->nodes, has_triangles) > 1;
  model_.parts.hidden.assign(
      model_.parts.are_nodes ? scene.nodes->nodes.size() : scene.mesh->materials.size(), false);
  model_.parts.changed = false;
}

// Triangles of no node are not hidden.
std::size_t HiddenParts::part_of(std::uint32_t triangle) const {
  const Scene& scene = model_.scene;
  if (!model_.parts.are_nodes) return scene.mesh->triangle_materials[triangle];
  const int node = scene.nodes->node_of(triangle);
  return node < 0 ? model_.parts.hidden.size() : as_size(node);
}

bool HiddenParts::apply() {
  if (!std::exchange(model_.parts.changed, false)) return false;
  auto mesh = std::make_shared<Mesh>(*model_.scene.mesh);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const std::size_t part = part_of(i);
    const glm::uvec3& whole = triangles_[i];
    const bool is_hidden = part < model_.parts.hidden.size() && model_.parts.hidden[part];
    mesh->triangles[i] = is_hidden ? glm::uvec3(whole.x) : whole;
  }
  model_.scene.mesh = std::move(mesh);
  model_.stats = analyze(model_.scene);
  return true;
}

Scene HiddenParts::whole_scene() const {
  Scene scene = model_.scene;
  if (!model_.parts.hides()) return scene;
  auto mesh = std::make_shared<Mesh>(*scene.mesh);
  mesh->triangles = triangles_;
  scene.mesh = std::move(mesh);
  return scene;
}

}  // namespace pinocchio::app
