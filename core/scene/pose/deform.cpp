#include <cmath>

#include "core/scene/pose/pose.h"

namespace pinocchio {
namespace {

template <class T>
std::vector<T> part_of_rest(const std::vector<T>& of_all, const Node& node) {
  if (of_all.empty()) return {};
  const auto first = of_all.begin() + node.first_vertex;
  return {first, first + node.vertices};
}

// Normals are transformed by the inverse transpose. The cofactors have its direction, even without an
// inverse.
glm::mat3 normals_to_world(const glm::mat4& m) {
  const glm::vec3 x(m[0]), y(m[1]), z(m[2]), yz = glm::cross(y, z);
  const float side = glm::dot(x, yz) < 0.0f ? -1.0f : 1.0f;
  return {side * yz, side * glm::cross(z, x), side * glm::cross(x, y)};
}

glm::vec3 unit_or_none(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
}

}  // namespace

Deformer::Deformer(const NodeTree& tree, std::size_t deformation, std::span<const glm::mat4> world)
    : tree_(tree),
      deformation_(tree.rest->deformations[deformation]),
      weights_(tree.weights[deformation]),
      world_from_node_(world[deformation_.node]) {
  if (deformation_.skin < 0) return;
  const Skin& skin = tree.rest->skins[deformation_.skin];
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    world_from_mesh_.push_back(world[skin.joints[j]] * skin.joint_from_mesh[j]);
}

bool Deformer::mirrors() const {
  return Placement(world_from_mesh_.empty() ? world_from_node_ : world_from_mesh_.front()).mirrors();
}

void Deformer::morph(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
                     std::vector<glm::vec4>& tangents) const {
  for (std::size_t t = 0; t < deformation_.targets.size(); ++t) {
    const MorphTarget& target = deformation_.targets[t];
    const float weight = weights_[t];
    if (weight == 0.0f) continue;
    for (std::size_t i = 0; i < target.vertices.size(); ++i) {
      const std::uint32_t v = target.vertices[i];
      if (!target.positions.empty()) positions[v] += weight * target.positions[i];
      // Zero stands for the triangle's normal, or for a tangent made from texture coordinates.
      if (!target.normals.empty() && normals[v] != glm::vec3(0.0f)) normals[v] += weight * target.normals[i];
      if (!target.tangents.empty() && !tangents.empty() && tangents[v].w != 0.0f)
        tangents[v] += glm::vec4(weight * target.tangents[i], 0.0f);
    }
  }
}

void Deformer::place(MeshData& mesh) const {
  const Node& node = tree_.nodes[deformation_.node];
  const RestPose& rest = *tree_.rest;
  std::vector<glm::vec3> positions = part_of_rest(rest.positions, node),
                         normals = part_of_rest(rest.normals, node);
  std::vector<glm::vec4> tangents;
  if (!mesh.tangents.empty()) tangents = part_of_rest(rest.tangents, node);
  morph(positions, normals, tangents);

  const Placement rigid(world_from_node_);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::size_t at = node.first_vertex + v;
    if (world_from_mesh_.empty()) {
      mesh.positions[at] = rigid.position(positions[v]);
      mesh.normals[at] = rigid.normal(normals[v]);
      if (!tangents.empty()) mesh.tangents[at] = rigid.tangent(tangents[v]);
      continue;
    }
    const std::size_t stride = deformation_.influences_per_vertex;
    glm::mat4 world(0.0f);
    for (std::size_t i = v * stride; i < (v + 1) * stride; ++i)
      if (const Influence& by = deformation_.influences[i]; by.weight != 0.0f)
        world += by.weight * world_from_mesh_[by.joint];
    mesh.positions[at] = glm::vec3(world * glm::vec4(positions[v], 1.0f));
    mesh.normals[at] =
        normals[v] == glm::vec3(0.0f) ? normals[v] : unit_or_none(normals_to_world(world) * normals[v]);
    if (!tangents.empty())
      mesh.tangents[at] =
          tangents[v].w == 0.0f
              ? glm::vec4(0.0f)
              : glm::vec4(glm::mat3(world) * glm::vec3(tangents[v]),
                          glm::determinant(glm::mat3(world)) < 0.0f ? -tangents[v].w : tangents[v].w);
  }
}

}  // namespace pinocchio
