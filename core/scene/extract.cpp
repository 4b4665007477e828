#include "pinocchio/extract.h"

#include <algorithm>
#include <limits>

#include "pinocchio/conversion.h"
#include "pinocchio/nodes.h"

namespace pinocchio {
namespace {

template <class T>
std::vector<T> chosen(const std::vector<T>& from, const std::vector<std::uint32_t>& places) {
  std::vector<T> to;
  if (from.empty()) return to;
  to.reserve(places.size());
  for (const std::uint32_t place : places) to.push_back(from[place]);
  return to;
}

// The mesh of the triangles that are wanted, in their order, and of their vertices.
MeshData part_of(const Mesh& mesh, const std::vector<bool>& wanted) {
  constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place_of(mesh.positions.size(), kNew), vertices;
  MeshData part;
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    if (!wanted[t]) continue;
    glm::uvec3 triangle = mesh.triangles[t];
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& place = place_of[triangle[corner]];
      if (place == kNew) {
        place = as_uint32(vertices.size());
        vertices.push_back(triangle[corner]);
      }
      triangle[corner] = place;
    }
    part.triangles.push_back(triangle);
    part.triangle_materials.push_back(mesh.triangle_materials[t]);
  }
  part.positions = chosen(mesh.positions, vertices);
  part.normals = chosen(mesh.normals, vertices);
  part.texcoords = chosen(mesh.texcoords, vertices);
  part.texcoords1 = chosen(mesh.texcoords1, vertices);
  part.colors = chosen(mesh.colors, vertices);
  part.tangents = chosen(mesh.tangents, vertices);
  part.materials = mesh.materials;
  part.maps = mesh.maps;
  part.textures = mesh.textures;
  return part;
}

}  // namespace

Expected<Scene> extracted(const Scene& scene, std::span<const int> nodes, bool with_children) {
  const auto fail = [&](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{scene.source, 0, what, remedy});
  };
  const std::size_t count = scene.nodes ? scene.nodes->nodes.size() : 0;
  std::vector<bool> taken(count, false);
  for (const int node : nodes) {
    if (node < 0 || as_size(node) >= count)
      return fail("there is no node " + std::to_string(node), "there are " + std::to_string(count));
    taken[as_size(node)] = true;
  }
  std::vector<bool> wanted(scene.mesh->triangles.size(), false);
  for (std::size_t n = 0; n < count; ++n) {
    const Node& node = scene.nodes->nodes[n];
    if (with_children && node.parent >= 0 && taken[as_size(node.parent)]) taken[n] = true;
    if (taken[n]) std::fill_n(wanted.begin() + node.first_triangle, node.triangles, true);
  }
  if (std::ranges::none_of(wanted, [](bool is) { return is; }))
    return fail("the nodes have no triangles", "there is nothing to draw");
  Scene part = scene;
  part.mesh = std::make_shared<const Mesh>(part_of(*scene.mesh, wanted));
  part.nodes = nullptr;
  part.animation = nullptr;
  return part;
}

}  // namespace pinocchio
