#include "pinocchio/mesh.h"

#include <array>

#include "core/parallel/parts.h"
#include "core/scene/mip_levels.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Gives materials whose triangles have coloured vertices maps with vertex_colors.
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

// Whether a vertex of the triangles with these maps has an alpha below 1.
bool has_faint_vertices(const MeshData& mesh, std::size_t maps) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t material = mesh.triangle_materials[i];
    if (material >= mesh.materials.size() || mesh.materials[material].maps != as_int(maps)) continue;
    for (int c = 0; c < 3; ++c)
      if (const std::uint32_t vertex = mesh.triangles[i][c];
          vertex < mesh.colors.size() && !(mesh.colors[vertex].a >= 1.0f))
        return true;
  }
  return false;
}

// Sets least_alpha of all materials.
void find_least_alpha(MeshData& mesh) {
  const auto of_texels = [&](const MaterialMaps& maps) {
    if (!maps.alpha.used()) return 1.0f;
    if (as_size(maps.alpha.texture) >= mesh.textures.size()) return 0.0f;
    return as_float(mesh.textures[as_size(maps.alpha.texture)].least[maps.alpha_channel]) / 255.0f;
  };
  for (std::size_t i = 0; i < mesh.maps.size(); ++i) {
    MaterialMaps& maps = mesh.maps[i];
    const bool is_asked = maps.alpha_mode != AlphaMode::opaque;
    maps.least_alpha =
        is_asked && !(maps.vertex_colors && has_faint_vertices(mesh, i)) ? of_texels(maps) : 0.0f;
  }
}

// The bounds of the vertices that triangles have. Indices out of range are skipped: check_scene reports them.
Bounds bounds_of(const MeshData& mesh) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 17;  // triangles
  std::vector<Bounds> parts(mesh.triangles.size() / kAtOnce + 1);
  for_each_part(mesh.triangles.size(), kAtOnce, [&](std::size_t first, std::size_t last) {
    std::array<Bounds, 3> own;  // one for each corner, so that no sum waits for another
    for (std::size_t i = first; i < last; ++i)
      for (int c = 0; c < 3; ++c)
        if (const std::uint32_t vertex = mesh.triangles[i][c]; vertex < mesh.positions.size())
          own[c].add(mesh.positions[vertex]);
    for (const Bounds& corner : own) parts[first / kAtOnce].add(corner);
  });
  Bounds all;
  for (const Bounds& part : parts) all.add(part);
  return all;
}

}  // namespace

MaterialMaps& make_maps(MeshData& mesh, Material& material) {
  if (material.maps < 0) {
    material.maps = as_int(mesh.maps.size());
    mesh.maps.emplace_back();
  }
  return mesh.maps[material.maps];
}

Mesh::Mesh(MeshData data) : MeshData(std::move(data)), bounds_(bounds_of(*this)) {
  let_vertex_colors_count(*this);
  finish_textures(*this, nullptr);
  find_least_alpha(*this);
}

Mesh::Mesh(const Mesh& other) : MeshData(other), bounds_(other.bounds_) {}

}  // namespace pinocchio
