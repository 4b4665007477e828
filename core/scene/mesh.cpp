#include "pinocchio/mesh.h"

#include <array>

#include "core/parallel/parts.h"
#include "core/scene/mip_levels.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Calls visit(material, colour) for the corners of all triangles. Indices out of range are skipped:
// check_scene reports them.
template <class Visit>
void for_each_colored_corner(const MeshData& mesh, Visit visit) {
  if (mesh.colors.size() != mesh.positions.size()) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.triangles[i][c], material = mesh.triangle_materials[i];
      if (vertex < mesh.colors.size() && material < mesh.materials.size())
        visit(material, mesh.colors[vertex]);
    }
}

// Gives materials whose triangles have coloured vertices maps with vertex_colors.
void let_vertex_colors_count(MeshData& mesh) {
  std::vector<bool> colored(mesh.materials.size(), false);
  for_each_colored_corner(mesh, [&](std::uint32_t material, const glm::vec4& color) {
    if (color != glm::vec4(1.0f)) colored[material] = true;
  });
  for (std::size_t i = 0; i < colored.size(); ++i)
    if (colored[i]) make_maps(mesh, mesh.materials[i]).vertex_colors = true;
}

// Sets least_alpha of the materials that have another mode than opaque.
void find_least_alpha(MeshData& mesh) {
  const auto texel = [&](const MaterialMaps& maps) {
    if (!maps.alpha.used()) return 1.0f;
    if (as_size(maps.alpha.texture) >= mesh.textures.size()) return 0.0f;
    return as_float(mesh.textures[as_size(maps.alpha.texture)].least[maps.alpha_channel]) / 255.0f;
  };
  bool asks_vertices = false;
  for (MaterialMaps& maps : mesh.maps) {
    const bool asks = maps.alpha_mode != AlphaMode::opaque;
    maps.least_alpha = asks ? texel(maps) : 0.0f;
    asks_vertices = asks_vertices || (asks && maps.vertex_colors);
  }
  if (!asks_vertices) return;
  for_each_colored_corner(mesh, [&](std::uint32_t material, const glm::vec4& color) {
    const int maps = mesh.materials[material].maps;
    if (maps >= 0 && as_size(maps) < mesh.maps.size() && !(color.a >= 1.0f))
      mesh.maps[maps].least_alpha = 0.0f;
  });
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
