#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>

#include "core/base/large_memory.h"
#include "core/math/finite.h"
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
      : file_(file),
        placement_(world_from_mesh),
        in_place_(world_from_mesh == glm::mat4(1.0f)),
        mesh_(mesh),
        rest_(rest),
        deformation_(deformation) {}

  Expected<void> add(const tinygltf::Primitive& primitive, std::uint32_t default_material) {
    const Expected<std::uint32_t> first = vertices(
        {attribute(primitive, "POSITION"), attribute(primitive, "NORMAL"), attribute(primitive, "TEXCOORD_0"),
         attribute(primitive, "TEXCOORD_1"), attribute(primitive, "COLOR_0"), attribute(primitive, "TANGENT"),
         deformation_ ? deforming_accessors(primitive) : std::vector<int>()},
        primitive);
    if (!first) return Unexpected(first.error());
    if (primitive.material >= 0 &&
        static_cast<std::size_t>(primitive.material) >= file_.model.materials.size())
      return file_.error("a primitive names material " + std::to_string(primitive.material) + ", there are " +
                         std::to_string(file_.model.materials.size()));
    const std::size_t before = mesh_.triangles.size();
    if (const Expected<void> added = add_corners(primitive, counts_[*first]); !added) return added;
    for (std::size_t i = before; i < mesh_.triangles.size(); ++i) {
      if (i % kTrianglesBetweenLooks == 0) throw_if_cancelled(file_.progress);
      glm::uvec3& triangle = mesh_.triangles[i];
      if (placement_.mirrors()) std::swap(triangle.y, triangle.z);
      triangle += *first;
      is_partly_smooth_ |= has_void_normals_ && is_partly_smooth(triangle);
    }
    resize_large(mesh_.triangle_materials, mesh_.triangles.size(),
                 primitive.material >= 0 ? static_cast<std::uint32_t>(primitive.material) : default_material);
    return {};
  }

  // Whether some normals of a triangle have no length. All three without ask for its own, as we save it.
  [[nodiscard]] bool is_partly_smooth() const { return is_partly_smooth_; }

 private:
  [[nodiscard]] bool is_partly_smooth(const glm::uvec3& triangle) const {
    int given = 0;
    for (int corner = 0; corner < 3; ++corner)
      given += rest_.normals[triangle[corner]] != glm::vec3(0.0f) ? 1 : 0;
    return given % 3 != 0;
  }

  // Appends the primitive's triangles, whose corners are counted from its first vertex.
  Expected<void> add_corners(const tinygltf::Primitive& primitive, std::size_t vertex_count) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      Expected<std::vector<std::uint32_t>> given = file_.indices(primitive.indices);
      if (!given) return Unexpected(given.error());
      indices = std::move(*given);
    } else {
      resize_large(indices, vertex_count);
      std::iota(indices.begin(), indices.end(), 0u);
    }
    std::uint32_t most = 0;
    for (const std::uint32_t index : indices) most = std::max(most, index);
    if (!indices.empty() && most >= vertex_count)
      return file_.error("a primitive names vertex " + std::to_string(most) + ", it has " +
                         std::to_string(vertex_count));
    const std::size_t before = mesh_.triangles.size(), count = triangle_count(primitive.mode, indices.size());
    resize_large(mesh_.triangles, before + count);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
      static_assert(sizeof(glm::uvec3) == 3 * sizeof(std::uint32_t));
      if (count > 0) std::memcpy(&mesh_.triangles[before], indices.data(), count * sizeof(glm::uvec3));
      return {};
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<std::size_t, 3> at = corners_of(primitive.mode, i);
      mesh_.triangles[before + i] = {indices[at[0]], indices[at[1]], indices[at[2]]};
    }
    return {};
  }

  // First of the scene's vertices made of these accessors; primitives that share them share the vertices.
  Expected<std::uint32_t> vertices(const Attributes& attributes, const tinygltf::Primitive& primitive) {
    const std::size_t first = mesh_.positions.size();
    const auto [at, is_new] = placed_.try_emplace(attributes, static_cast<std::uint32_t>(first));
    if (!is_new) return at->second;
    if (const Expected<void> read = file_.append(attributes.position, rest_.positions); !read)
      return Unexpected(read.error());
    const std::size_t count = rest_.positions.size() - first;
    for (const Expected<void>& read : {append(attributes.normal, count, glm::vec3(0.0f), rest_.normals),
                                       append(attributes.texcoord, count, glm::vec2(0.0f), mesh_.texcoords),
                                       append(attributes.texcoord1, count, glm::vec2(0.0f), mesh_.texcoords1),
                                       append_colors(attributes.color, count),
                                       append(attributes.tangent, count, glm::vec4(0.0f), rest_.tangents)})
      if (!read) return Unexpected(read.error());
    resize_large(rest_.normals, first + count);
    if (attributes.normal >= 0) drop_void_normals(first);
    place(first);
    if (deformation_)
      if (const Expected<void> added = deformation_->add(primitive, at->second, count); !added)
        return Unexpected(added.error());
    counts_[at->second] = count;
    return at->second;
  }

  // One for each of the `count` last vertices, `none` where the primitive has no such attribute. What no
  // primitive has yet stays empty.
  template <class T>
  Expected<void> append(int accessor, std::size_t count, const T& none, std::vector<T>& to) const {
    const std::size_t first = mesh_.positions.size();
    if (accessor < 0 && to.empty()) return {};
    resize_large(to, first, none);
    if (accessor < 0) {
      resize_large(to, first + count, none);
      return {};
    }
    Expected<void> read = file_.append(accessor, to);
    if (read && to.size() != first + count)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    return read;
  }

  // RGB or RGBA; white where the primitive has none.
  Expected<void> append_colors(int accessor, std::size_t count) {
    const auto index = static_cast<std::size_t>(accessor);
    const bool opaque = accessor >= 0 && index < file_.model.accessors.size() &&
                        file_.model.accessors[index].type == TINYGLTF_TYPE_VEC3;
    if (!opaque) return append(accessor, count, glm::vec4(1.0f), mesh_.colors);
    std::vector<glm::vec3> rgb;
    if (const Expected<void> read = file_.append(accessor, rgb); !read) return read;
    if (rgb.size() != count)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    resize_large(mesh_.colors, mesh_.positions.size(), glm::vec4(1.0f));
    for (const glm::vec3& c : rgb) mesh_.colors.emplace_back(c, 1.0f);
    return {};
  }

  void drop_void_normals(std::size_t first) {
    constexpr float kLeast = 1e-12f;  // squared: what shading takes for none
    for (std::size_t i = first; i < rest_.normals.size(); ++i) {
      if (glm::dot(rest_.normals[i], rest_.normals[i]) > kLeast || !is_finite(rest_.normals[i])) continue;
      rest_.normals[i] = glm::vec3(0.0f);
      has_void_normals_ = true;
    }
  }

  // The vertices from `first` on, as the world sees them.
  void place(std::size_t first) {
    const auto placed = [first](const auto& rest, auto& to, const auto& place_one) {
      resize_large(to, rest.size());
      std::transform(rest.begin() + static_cast<std::ptrdiff_t>(first), rest.end(),
                     to.begin() + static_cast<std::ptrdiff_t>(first), place_one);
    };
    if (in_place_) {
      const auto as_it_is = [](const glm::vec3& v) { return v; };
      placed(rest_.positions, mesh_.positions, as_it_is);
      placed(rest_.normals, mesh_.normals, as_it_is);
    } else {
      placed(rest_.positions, mesh_.positions, [this](const glm::vec3& p) { return placement_.position(p); });
      placed(rest_.normals, mesh_.normals, [this](const glm::vec3& n) { return placement_.normal(n); });
    }
    if (rest_.tangents.empty()) return;
    placed(rest_.tangents, mesh_.tangents, [this](const glm::vec4& t) { return placement_.tangent(t); });
  }

  const GltfFile& file_;
  Placement placement_;
  bool in_place_;  // nothing moves
  MeshData& mesh_;
  RestPose& rest_;
  DeformationReader* deformation_;  // null: nothing deforms it
  std::map<Attributes, std::uint32_t> placed_;
  std::map<std::uint32_t, std::size_t> counts_;  // of vertices, by the first of them
  bool has_void_normals_ = false, is_partly_smooth_ = false;
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
  if (placer.is_partly_smooth())
    warnings.add({file.path.string(), "mesh " + std::to_string(mesh), "normals of no length are left out",
                  "triangles there are shaded by their other corners' alone"});
  return {};
}

}  // namespace pinocchio
