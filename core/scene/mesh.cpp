#include "pinocchio/mesh.h"

#include "core/scene/mip_levels.h"

namespace pinocchio {
namespace {

// Materials whose triangles have coloured vertices have maps that say so.
void let_vertex_colors_count(MeshData& mesh) {
  if (mesh.colors.size() != mesh.positions.size()) return;
  std::vector<bool> colored(mesh.materials.size(), false);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.triangles[i][c], material = mesh.triangle_materials[i];
      if (vertex < mesh.colors.size() && material < colored.size() && mesh.colors[vertex] != glm::vec4(1.0f))
        colored[material] = true;
    }
  for (std::size_t i = 0; i < colored.size(); ++i)
    if (colored[i]) make_maps(mesh, mesh.materials[i]).vertex_colors = true;
}

}  // namespace

MaterialMaps& make_maps(MeshData& mesh, Material& material) {
  if (material.maps < 0) {
    material.maps = static_cast<int>(mesh.maps.size());
    mesh.maps.emplace_back();
  }
  return mesh.maps[static_cast<std::size_t>(material.maps)];
}

// A vertex that there is not is left to check_scene.
Mesh::Mesh(MeshData data) : MeshData(std::move(data)) {
  for (const glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i)
      if (t[i] < positions.size()) bounds_.add(positions[t[i]]);
  let_vertex_colors_count(*this);
  make_smaller_levels(*this, nullptr);
}

}  // namespace pinocchio
