#include "core/image/tonemap.h"
#include "core/scene/input_file.h"
#include "core/scene/loaders.h"
#include "core/scene/ply_file.h"
#include "core/scene/polygon.h"

namespace pinocchio {
namespace {

// A column by any of its names; -1 where the file has none of them.
int column(const PlyElement& element, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (element.properties[i].name == name) return static_cast<int>(i);
  return -1;
}

// Columns of vectors, each of them there or not.
struct VertexColumns {
  explicit VertexColumns(const PlyElement& e)
      : x{column(e, {"x"}), column(e, {"y"}), column(e, {"z"})},
        n{column(e, {"nx", "normal_x"}), column(e, {"ny", "normal_y"}), column(e, {"nz", "normal_z"})},
        c{column(e, {"red", "r", "diffuse_red"}), column(e, {"green", "g", "diffuse_green"}),
          column(e, {"blue", "b", "diffuse_blue"}), column(e, {"alpha", "a", "diffuse_alpha"})} {}
  int x[3], n[3], c[4];

  [[nodiscard]] bool positions() const { return x[0] >= 0 && x[1] >= 0 && x[2] >= 0; }
  [[nodiscard]] bool normals() const { return n[0] >= 0 && n[1] >= 0 && n[2] >= 0; }
  [[nodiscard]] bool colors() const { return c[0] >= 0 && c[1] >= 0 && c[2] >= 0; }
};

class PlyBuilder {
 public:
  PlyBuilder(const std::filesystem::path& path, PlyFile& ply, Loading& loading)
      : path_(path), ply_(ply), loading_(loading) {}

  Expected<MeshData> build() {
    for (const PlyElement& element : ply_.elements()) {
      const Expected<void> read = element.name == "vertex"      ? vertices(element)
                                  : element.name == "face"      ? faces(element)
                                  : element.name == "tristrips" ? strips(element)
                                                                : others(element);
      if (!read) return Unexpected(read.error());
    }
    if (!faces_seen_ && !mesh_.positions.empty())
      lost("element vertex", "points are left out", "they are not drawn");
    Material& material = mesh_.materials.emplace_back();
    material.name = "default";
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), glm::vec4(1.0f));
    if (!mesh_.colors.empty()) material.ambient = material.diffuse = glm::vec3(1.0f);
    mesh_.triangle_materials.assign(mesh_.triangles.size(), 0);
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kRowsBetweenLooks = 4096;

  void lost(const std::string& where, const std::string& what, const std::string& loss) {
    loading_.warnings.add({path_.string(), where, what, loss});
  }

  template <class Take>
  Expected<void> rows(const PlyElement& element, Take take) {
    begin_phase(loading_.progress, "mesh", static_cast<double>(element.count));
    PlyRow row;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (const Expected<void> read = ply_.read_row(element, row); !read) return read;
      if (const Expected<void> taken = take(row); !taken) return taken;
      if (i % kRowsBetweenLooks == kRowsBetweenLooks - 1) advance(loading_.progress, kRowsBetweenLooks);
    }
    return {};
  }

  Expected<void> vertices(const PlyElement& element) {
    const VertexColumns at(element);
    if (!at.positions()) return ply_.error("its vertices have no x, y and z");
    const auto value = [](const PlyRow& row, int i) {
      return static_cast<float>(row.numbers[static_cast<std::size_t>(i)]);
    };
    const auto color = [&](const PlyRow& row, int i) {
      return value(row, i) * element.properties[static_cast<std::size_t>(i)].color_scale();
    };
    for (const PlyProperty& p : element.properties)
      if (p.name == "u" || p.name == "s" || p.name == "texture_u")
        lost("", "texture coordinates are left out", "PLY names no texture");
    return rows(element, [&](const PlyRow& row) -> Expected<void> {
      mesh_.positions.emplace_back(value(row, at.x[0]), value(row, at.x[1]), value(row, at.x[2]));
      mesh_.normals.push_back(at.normals()
                                  ? glm::vec3(value(row, at.n[0]), value(row, at.n[1]), value(row, at.n[2]))
                                  : glm::vec3(0.0f));
      if (at.colors())
        mesh_.colors.emplace_back(
            srgb_to_linear({color(row, at.c[0]), color(row, at.c[1]), color(row, at.c[2])}),
            at.c[3] < 0 ? 1.0f : color(row, at.c[3]));
      return {};
    });
  }

  Expected<void> faces(const PlyElement& element) {
    const int indices = column(element, {"vertex_indices", "vertex_index"});
    if (indices < 0 || !element.properties[static_cast<std::size_t>(indices)].is_list)
      return ply_.error("its faces have no list vertex_indices");
    for (const PlyProperty& p : element.properties) {
      if (p.name == "red") lost("element face", "colours of faces are left out", "all of it has one colour");
      if (p.name == "texcoord")
        lost("element face", "texture coordinates are left out", "PLY names no texture");
    }
    return rows(element,
                [&](const PlyRow& row) { return polygon(row.lists[static_cast<std::size_t>(indices)]); });
  }

  Expected<void> polygon(const std::vector<double>& indices) {
    faces_seen_ = true;
    if (indices.size() < 3) {
      lost("element face", "faces of fewer than three corners are left out", "they are not drawn");
      return {};
    }
    corners_.clear();
    for (const double index : indices) {
      if (!(index >= 0.0 && index < static_cast<double>(mesh_.positions.size())))
        return no_such_vertex(index);
      corners_.push_back(mesh_.positions[static_cast<std::size_t>(index)]);
    }
    const PolygonTriangles polygon = triangulate(corners_);
    if (!polygon.simple)
      lost("element face", "a face crosses itself", "which parts of it are filled is a guess");
    for (const glm::uvec3& t : polygon.triangles)
      mesh_.triangles.emplace_back(indices[t.x], indices[t.y], indices[t.z]);
    return {};
  }

  [[nodiscard]] Unexpected no_such_vertex(double index) const {
    return ply_.error("a face names vertex " + std::to_string(index) + ", there are " +
                      std::to_string(mesh_.positions.size()) + " so far");
  }

  // Strips one after the other, divided by -1, as scanned models have them.
  Expected<void> strips(const PlyElement& element) {
    const int indices = column(element, {"vertex_indices", "vertex_index"});
    if (indices < 0) return ply_.error("its triangle strips have no list vertex_indices");
    faces_seen_ = true;
    return rows(element, [&](const PlyRow& row) -> Expected<void> {
      const std::vector<double>& list = row.lists[static_cast<std::size_t>(indices)];
      std::size_t first = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] < 0.0)
          first = i + 1;
        else if (!(list[i] < static_cast<double>(mesh_.positions.size())))
          return no_such_vertex(list[i]);
        if (i < first + 2) continue;
        glm::uvec3 t(list[i - 2], list[i - 1], list[i]);
        if ((i - first) % 2 == 1) std::swap(t.x, t.y);
        mesh_.triangles.push_back(t);
      }
      return {};
    });
  }

  Expected<void> others(const PlyElement& element) {
    if (element.count > 0 && !element.properties.empty())
      lost("element " + element.name, "elements other than vertices and faces are left out",
           "they are not drawn");
    if (element.properties.empty()) return {};
    return rows(element, [](const PlyRow&) -> Expected<void> { return {}; });
  }

  const std::filesystem::path& path_;
  PlyFile& ply_;
  Loading& loading_;
  MeshData mesh_;
  std::vector<glm::vec3> corners_;
  bool faces_seen_ = false;
};

}  // namespace

Expected<Scene> load_ply(const std::filesystem::path& path, Loading& loading) {
  Expected<std::string> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  Expected<PlyFile> ply = PlyFile::open(path, std::move(*bytes));
  if (!ply) return Unexpected(ply.error());
  Expected<MeshData> mesh = PlyBuilder(path, *ply, loading).build();
  if (!mesh) return Unexpected(mesh.error());
  return Scene(std::move(*mesh));
}

}  // namespace pinocchio
