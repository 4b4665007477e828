#include "core/scene/gltf/save/mesh.h"

#include <algorithm>

#include "core/scene/gltf/save/materials.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = GltfData::Json;

// Accessors of what only some materials look up; -1: the mesh has none.
struct SometimesUsed {
  int texcoord = -1, texcoord1 = -1, color = -1, tangent = -1;
};

template <class T>
std::span<const T> of_part(const std::vector<T>& all, const SavedPart& part) {
  return all.empty() ? std::span<const T>()
                     : std::span(all).subspan(part.first_vertex, part.positions.size());
}

SometimesUsed add_sometimes_used(const Mesh& mesh, const SavedPart& part, GltfData& data) {
  const auto add = [&](const auto& elements, const char* type) {
    return elements.empty() ? -1 : data.add_accessor(elements, kGltfFloat, type);
  };
  SometimesUsed result;
  result.texcoord = add(of_part(mesh.texcoords, part), "VEC2");
  result.texcoord1 = add(of_part(mesh.texcoords1, part), "VEC2");
  result.color = add(of_part(mesh.colors, part), "VEC4");
  result.tangent = add(part.tangents, "VEC4");
  return result;
}

// indices: of the primitive's corners, within the part.
void add_attributes(const SometimesUsed& known, const MaterialMaps* maps, const SavedPart& part,
                    const std::vector<std::uint32_t>& indices, Json& to) {
  if (!maps) return;
  if (known.texcoord >= 0) to["TEXCOORD_0"] = known.texcoord;
  if (known.texcoord1 >= 0) {
    to["TEXCOORD_1"] = known.texcoord1;
    if (known.texcoord < 0) to["TEXCOORD_0"] = known.texcoord1;  // glTF counts them from 0
  }
  if (known.color >= 0 && maps->vertex_colors) to["COLOR_0"] = known.color;
  const auto given = [&part](std::uint32_t vertex) { return part.tangents[vertex].w != 0.0f; };
  if (known.tangent >= 0 && maps->normal.used() && std::all_of(indices.begin(), indices.end(), given))
    to["TANGENT"] = known.tangent;
}

}  // namespace

int add_positions(std::span<const glm::vec3> positions, GltfData& data) {
  const int accessor = data.add_accessor(positions, kGltfFloat, "VEC3");
  Bounds b;
  for (const glm::vec3& p : positions) b.add(p);
  data.add_bounds(vec3_json(b.lo), vec3_json(b.hi));
  return accessor;
}

Json gltf_primitives(const Mesh& mesh, const SavedPart& part, const Json& more, GltfData& data) {
  Json attributes{{"POSITION", add_positions(part.positions, data)}};
  const auto given = [](const glm::vec3& n) { return n != glm::vec3(0.0f); };
  if (std::any_of(part.normals.begin(), part.normals.end(), given))
    attributes["NORMAL"] = data.add_accessor(part.normals, kGltfFloat, "VEC3");
  attributes.update(more);
  const SometimesUsed known = add_sometimes_used(mesh, part, data);
  Json primitives = Json::array();
  const std::size_t last = std::size_t{part.first_triangle} + part.triangles;
  for (std::size_t first = part.first_triangle; first < last;) {
    const std::uint32_t material = mesh.triangle_materials[first];
    std::vector<std::uint32_t> indices;
    std::size_t end = first;
    for (; end < last && mesh.triangle_materials[end] == material; ++end) {
      const glm::uvec3 t = mesh.triangles[end] - part.first_vertex;
      indices.insert(indices.end(), {t.x, part.turned ? t.z : t.y, part.turned ? t.y : t.z});
    }
    Json own = attributes;
    add_attributes(known, mesh.maps_of(as_uint32(first)), part, indices, own);
    primitives.push_back(
        {{"attributes", own},
         {"indices", data.add_accessor(std::span<const std::uint32_t>(indices), kGltfUnsignedInt, "SCALAR")},
         {"material", material}});
    first = end;
  }
  return primitives;
}

}  // namespace pinocchio
