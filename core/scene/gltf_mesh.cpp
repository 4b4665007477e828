#include <array>
#include <map>
#include <numeric>

#include "core/scene/gltf_deformation.h"

namespace pinocchio {
namespace {

// Accessors of a primitive's attributes; -1: it has none.
struct Attributes {
  int position = -1, normal = -1, texcoord = -1, texcoord1 = -1, color = -1, tangent = -1;
  std::vector<int> deforming{};
  auto operator<=>(const Attributes&) const = default;
};

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

// Where triangle i of a list, strip or fan finds its corners; a strip turns every other one around.
std::array<std::size_t, 3> corners_of(int mode, std::size_t i) {
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
    return i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {0, i + 1, i + 2};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

std::size_t triangle_count(int mode, std::size_t indices) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

constexpr std::size_t kTrianglesBetweenLooks = 1 << 16;

// Vertices or triangles' corners, whichever are more.
std::size_t elements_of(const GltfFile& file, const tinygltf::Primitive& primitive) {
  std::size_t most = 0;
  for (const int accessor : {attribute(primitive, "POSITION"), primitive.indices})
    if (accessor >= 0 && static_cast<std::size_t>(accessor) < file.model.accessors.size())
      most = std::max(most, file.model.accessors[static_cast<std::size_t>(accessor)].count);
  return most;
}

class MeshPlacer {
 public:
  MeshPlacer(const GltfFile& file, const glm::mat4& world_from_mesh, MeshData& mesh, RestPose& rest,
             DeformationReader* deformation)
      : file_(file), placement_(world_from_mesh), mesh_(mesh), rest_(rest), deformation_(deformation) {}

  Expected<void> add(const tinygltf::Primitive& primitive, std::uint32_t default_material) {
    const Expected<std::uint32_t> first = vertices(
        {attribute(primitive, "POSITION"), attribute(primitive, "NORMAL"), attribute(primitive, "TEXCOORD_0"),
         attribute(primitive, "TEXCOORD_1"), attribute(primitive, "COLOR_0"), attribute(primitive, "TANGENT"),
         deformation_ ? deforming_accessors(primitive) : std::vector<int>()},
        primitive);
    if (!first) return Unexpected(first.error());
    const std::size_t vertex_count = counts_[*first];
    std::vector<std::uint32_t> indices(vertex_count);
    std::iota(indices.begin(), indices.end(), 0u);
    if (primitive.indices >= 0) {
      Expected<std::vector<std::uint32_t>> given = file_.indices(primitive.indices);
      if (!given) return Unexpected(given.error());
      indices = std::move(*given);
    }
    for (const std::uint32_t index : indices)
      if (index >= vertex_count)
        return file_.error("a primitive names vertex " + std::to_string(index) + ", it has " +
                           std::to_string(vertex_count));
    if (primitive.material >= 0 &&
        static_cast<std::size_t>(primitive.material) >= file_.model.materials.size())
      return file_.error("a primitive names material " + std::to_string(primitive.material) + ", there are " +
                         std::to_string(file_.model.materials.size()));

    const std::size_t count = triangle_count(primitive.mode, indices.size());
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kTrianglesBetweenLooks == 0) throw_if_cancelled(file_.progress);
      const std::array<std::size_t, 3> at = corners_of(primitive.mode, i);
      glm::uvec3 triangle(indices[at[0]], indices[at[1]], indices[at[2]]);
      if (placement_.mirrors()) std::swap(triangle.y, triangle.z);
      mesh_.triangles.push_back(triangle + *first);
      mesh_.triangle_materials.push_back(
          primitive.material >= 0 ? static_cast<std::uint32_t>(primitive.material) : default_material);
    }
    return {};
  }

 private:
  // First of the scene's vertices made of these accessors; primitives that share them share the vertices.
  Expected<std::uint32_t> vertices(const Attributes& attributes, const tinygltf::Primitive& primitive) {
    const auto [at, is_new] =
        placed_.try_emplace(attributes, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return at->second;
    const Expected<std::vector<float>> positions = file_.floats(attributes.position, 3);
    if (!positions) return Unexpected(positions.error());
    const std::size_t count = positions->size() / 3;
    const Expected<std::vector<float>> normals = optional(attributes.normal, 3, count);
    if (!normals) return Unexpected(normals.error());
    const Expected<std::vector<float>> texcoords = optional(attributes.texcoord, 2, count);
    if (!texcoords) return Unexpected(texcoords.error());
    const Expected<std::vector<float>> texcoords1 = optional(attributes.texcoord1, 2, count);
    if (!texcoords1) return Unexpected(texcoords1.error());
    const Expected<std::vector<glm::vec4>> vertex_colors = colors(attributes.color, count);
    if (!vertex_colors) return Unexpected(vertex_colors.error());
    const Expected<std::vector<float>> tangents = optional(attributes.tangent, 4, count);
    if (!tangents) return Unexpected(tangents.error());
    mesh_.colors.insert(mesh_.colors.end(), vertex_colors->begin(), vertex_colors->end());
    for (std::size_t i = 0; i < count; ++i) {
      const float *t1 = &(*texcoords1)[2 * i], *u = &(*tangents)[4 * i];
      mesh_.texcoords1.emplace_back(t1[0], t1[1]);
      rest_.tangents.emplace_back(u[0], u[1], u[2], u[3]);
      mesh_.tangents.push_back(placement_.tangent(rest_.tangents.back()));
      const float *p = &(*positions)[3 * i], *n = &(*normals)[3 * i], *t = &(*texcoords)[2 * i];
      rest_.positions.emplace_back(p[0], p[1], p[2]);
      rest_.normals.emplace_back(n[0], n[1], n[2]);
      mesh_.positions.push_back(placement_.position(rest_.positions.back()));
      mesh_.normals.push_back(placement_.normal(rest_.normals.back()));
      mesh_.texcoords.emplace_back(t[0], t[1]);
    }
    if (deformation_)
      if (const Expected<void> added = deformation_->add(primitive, at->second, count); !added)
        return Unexpected(added.error());
    counts_[at->second] = count;
    return at->second;
  }

  // RGB or RGBA; white where the primitive has none.
  Expected<std::vector<glm::vec4>> colors(int accessor, std::size_t count) const {
    std::vector<glm::vec4> result(count, glm::vec4(1.0f));
    if (accessor < 0) return result;
    const bool known = static_cast<std::size_t>(accessor) < file_.model.accessors.size();
    const std::size_t width =
        known && file_.model.accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC3 ? 3 : 4;
    const Expected<std::vector<float>> values = optional(accessor, static_cast<int>(width), count);
    if (!values) return Unexpected(values.error());
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < width; ++c) result[i][static_cast<int>(c)] = (*values)[width * i + c];
    return result;
  }

  // Zeros where the primitive has no such attribute.
  Expected<std::vector<float>> optional(int accessor, int components, std::size_t count) const {
    const std::size_t size = count * static_cast<std::size_t>(components);
    if (accessor < 0) return std::vector<float>(size, 0.0f);
    Expected<std::vector<float>> values = file_.floats(accessor, components);
    if (values && values->size() != size)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    return values;
  }

  const GltfFile& file_;
  Placement placement_;
  MeshData& mesh_;
  RestPose& rest_;
  DeformationReader* deformation_;  // null: nothing deforms it
  std::map<Attributes, std::uint32_t> placed_;
  std::map<std::uint32_t, std::size_t> counts_;  // of vertices, by the first of them
};

}  // namespace

Expected<void> add_gltf_mesh(const GltfFile& file, int mesh, const glm::mat4& world_from_mesh,
                             std::uint32_t default_material, MeshData& to, RestPose& rest,
                             DeformationReader* deformation, Warnings& warnings) {
  if (mesh < 0 || static_cast<std::size_t>(mesh) >= file.model.meshes.size())
    return file.error("a node names mesh " + std::to_string(mesh) + ", there are " +
                      std::to_string(file.model.meshes.size()));
  MeshPlacer placer(file, world_from_mesh, to, rest, deformation);
  for (const tinygltf::Primitive& primitive : file.model.meshes[static_cast<std::size_t>(mesh)].primitives) {
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
      const bool points = primitive.mode == TINYGLTF_MODE_POINTS;
      warnings.add({file.path.string(), "mesh " + std::to_string(mesh),
                    points ? "points are left out" : "lines are left out", "they are not drawn"});
      continue;
    }
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN)
      return file.error("a primitive has the mode " + std::to_string(primitive.mode) +
                        ", which glTF does not know");
    if (attribute(primitive, "POSITION") < 0) {
      warnings.add({file.path.string(), "mesh " + std::to_string(mesh),
                    "primitives without positions are left out", "they are not drawn"});
      continue;
    }
    // Copies are not in the file; the first placing is counted with them.
    if (!file.limit->take(file.path.string(), "placing mesh " + std::to_string(mesh),
                          elements_of(file, primitive), 40))
      return Unexpected(*file.limit->error());
    if (const Expected<void> added = placer.add(primitive, default_material); !added) return added;
  }
  return {};
}

}  // namespace pinocchio
