#include "core/scene/obj/mesh.h"

#include <boost/functional/hash.hpp>
#include <unordered_map>

#include "core/geometry/polygon.h"
#include "core/image/tonemap.h"
#include "core/scene/strokes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// A vertex is one combination of position, normal, texture coordinate and, where normals are made from a
// smoothing group, that group.
class ObjMeshBuilder {
 public:
  ObjMeshBuilder(const ObjText& obj, MeshData& mesh) : obj_(obj), mesh_(mesh) {
    vertices_.reserve(obj.positions.size());
  }

  void add(const ObjText::Face& face, std::uint32_t material, const PolygonTriangles& polygon) {
    for (const glm::uvec3& corners : polygon.triangles) {
      glm::uvec3 triangle;
      for (int i = 0; i < 3; ++i)
        triangle[i] = vertex_of(obj_.corners[face.first + corners[i]], face.smoothing_group);
      mesh_.triangles.push_back(triangle);
      mesh_.triangle_materials.push_back(material);
      if (face.smoothing_group == 0) continue;
      const glm::vec3 a = mesh_.positions[triangle.x];
      const glm::vec3 n = glm::cross(mesh_.positions[triangle.y] - a, mesh_.positions[triangle.z] - a);
      for (int i = 0; i < 3; ++i)
        if (obj_.corners[face.first + corners[i]].normal < 0)
          mesh_.normals[triangle[i]] += n;  // weighted by area
    }
  }

  // The vertex of a point or a line's end.
  std::uint32_t vertex_of(const ObjText::Corner& corner) { return vertex_of(corner, 0); }

  void finish() {
    if (any_texcoord_) join_seams();
    for (const SmoothVertex& smooth : smooth_vertices_)
      if (glm::vec3& n = mesh_.normals[smooth.vertex]; n != glm::vec3(0.0f)) n = glm::normalize(n);
    if (!any_texcoord_) mesh_.texcoords.clear();
  }

 private:
  struct Key {
    ObjText::Corner corner;
    std::uint32_t group;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::size_t hash = k.group;
      boost::hash_combine(hash, k.corner.position);
      boost::hash_combine(hash, k.corner.texcoord);
      boost::hash_combine(hash, k.corner.normal);
      return hash;
    }
  };

  // One that gets its normal from the faces of a smoothing group.
  struct SmoothVertex {
    std::uint32_t vertex, group;
    int position;
  };

  // Vertices of a group at one position have one normal, whatever their texture coordinates.
  void join_seams() {
    using Place = std::pair<int, std::uint32_t>;
    std::unordered_map<Place, glm::vec3, boost::hash<Place>> sums;
    sums.reserve(smooth_vertices_.size());
    for (const SmoothVertex& v : smooth_vertices_) sums[{v.position, v.group}] += mesh_.normals[v.vertex];
    for (const SmoothVertex& v : smooth_vertices_) mesh_.normals[v.vertex] = sums[{v.position, v.group}];
  }

  std::uint32_t vertex_of(const ObjText::Corner& corner, std::uint32_t smoothing_group) {
    const std::uint32_t group = corner.normal < 0 ? smoothing_group : 0;
    const auto [at, is_new] = vertices_.try_emplace({corner, group}, as_uint32(mesh_.positions.size()));
    if (!is_new) return at->second;
    if (group > 0) smooth_vertices_.push_back({at->second, group, corner.position});
    append(corner);
    return at->second;
  }

  void append(const ObjText::Corner& corner) {
    const auto position = as_size(corner.position);
    mesh_.positions.push_back(obj_.positions[position]);
    mesh_.normals.push_back(corner.normal < 0 ? glm::vec3(0.0f) : obj_.normals[corner.normal]);
    if (!obj_.colors.empty()) mesh_.colors.emplace_back(srgb_to_linear(obj_.colors[position]), 1.0f);
    glm::vec2 texcoord(0.0f);
    if (corner.texcoord >= 0) {
      const glm::vec2& t = obj_.texcoords[corner.texcoord];
      texcoord = {t.x, 1.0f - t.y};  // OBJ's v points up
      any_texcoord_ = true;
    }
    mesh_.texcoords.push_back(texcoord);
  }

  const ObjText& obj_;
  MeshData& mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> vertices_;
  std::vector<SmoothVertex> smooth_vertices_;
  bool any_texcoord_ = false;
};

}  // namespace

void add_obj_faces(const ObjText& obj, const std::vector<std::uint32_t>& materials,
                   const std::filesystem::path& file, Loading& loading, MeshData& mesh) {
  constexpr std::size_t kFacesBetweenLooks = 4096;
  begin_phase(loading.progress, "mesh", obj.faces.size());
  ObjMeshBuilder builder(obj, mesh);
  std::vector<glm::vec3> corners;
  for (std::size_t i = 0; i < obj.faces.size(); ++i) {
    const ObjText::Face& face = obj.faces[i];
    corners.clear();
    for (std::size_t c = 0; c < face.count; ++c)
      corners.push_back(obj.positions[obj.corners[face.first + c].position]);
    const PolygonTriangles polygon = triangulate(corners);
    if (!polygon.simple)
      loading.warnings.add({file.string(), "line " + std::to_string(face.line), "a face crosses itself",
                            "which parts of it are filled is a guess"});
    builder.add(face, face.material < 0 ? 0 : materials[face.material], polygon);
    if (i % kFacesBetweenLooks == kFacesBetweenLooks - 1) advance(loading.progress, kFacesBetweenLooks);
  }
  builder.finish();
}

Expected<void> add_obj_strokes(const ObjText& obj, const std::vector<std::uint32_t>& materials,
                               const std::filesystem::path& file, Loading& loading, MeshData& mesh) {
  if (obj.strokes.empty()) return {};
  double points = 0.0, lines = 0.0;
  for (const ObjText::Stroke& stroke : obj.strokes)
    (stroke.is_point ? points : lines) += as_double(stroke.count - (stroke.is_point ? 0 : 1));
  if (const Expected<void> fits = take_strokes(file.string(), points, lines, loading); !fits) return fits;
  MeshData ends;  // the vertices that points and lines have
  ObjMeshBuilder builder(obj, ends);
  std::vector<Stroke> strokes;
  for (const ObjText::Stroke& stroke : obj.strokes) {
    const std::uint32_t material = stroke.material < 0 ? 0 : materials[stroke.material];
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < stroke.count; ++i) {
      const std::uint32_t vertex = builder.vertex_of(obj.corners[stroke.first + i]);
      if (stroke.is_point)
        strokes.push_back({vertex, vertex, true, material});
      else if (i > 0)
        strokes.push_back({last, vertex, false, material});
      last = vertex;
    }
  }
  builder.finish();
  const AddedStrokes added = add_strokes(strokes, ends, loading.strokes, loading.progress, mesh);
  warn_of_unplaced(file.string(), "", added.unplaced, loading.warnings);
  return {};
}

}  // namespace pinocchio
