#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/base/decimal.h"
#include "core/files/input_file.h"
#include "core/geometry/polygon.h"
#include "core/image/codecs/texture_file.h"
#include "core/image/tonemap.h"
#include "core/math/finite.h"
#include "core/scene/formats.h"
#include "core/scene/ply/file.h"
#include "core/scene/strokes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The column with one of these names; -1: there is none.
int column(const PlyElement& element, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (element.properties[i].name == name) return as_int(i);
  return -1;
}

float value(const PlyRow& row, int i) {
  return as_float(row.numbers[i]);
}

// Columns of a vertex's or a face's colour; -1: it is missing.
struct ColorColumns {
  explicit ColorColumns(const PlyElement& e)
      : element(e),
        c{column(e, {"red", "r", "diffuse_red"}), column(e, {"green", "g", "diffuse_green"}),
          column(e, {"blue", "b", "diffuse_blue"}), column(e, {"alpha", "a", "diffuse_alpha"})} {}
  const PlyElement& element;
  int c[4];

  [[nodiscard]] bool there() const { return c[0] >= 0 && c[1] >= 0 && c[2] >= 0; }
  [[nodiscard]] glm::vec4 of(const PlyRow& row) const {
    const auto full = [&](int i) { return value(row, i) * element.properties[i].color_scale(); };
    return {srgb_to_linear({full(c[0]), full(c[1]), full(c[2])}), c[3] < 0 ? 1.0f : full(c[3])};
  }
};

// Columns of vectors; -1: one is missing.
struct VertexColumns {
  explicit VertexColumns(const PlyElement& e)
      : x{column(e, {"x"}), column(e, {"y"}), column(e, {"z"})},
        n{column(e, {"nx", "normal_x"}), column(e, {"ny", "normal_y"}), column(e, {"nz", "normal_z"})},
        uv{column(e, {"s", "u", "texture_u"}), column(e, {"t", "v", "texture_v"})} {}
  int x[3], n[3], uv[2];

  [[nodiscard]] bool positions() const { return x[0] >= 0 && x[1] >= 0 && x[2] >= 0; }
  [[nodiscard]] bool normals() const { return n[0] >= 0 && n[1] >= 0 && n[2] >= 0; }
  [[nodiscard]] bool texcoords() const { return uv[0] >= 0 && uv[1] >= 0; }
};

class PlyBuilder {
 public:
  PlyBuilder(const std::filesystem::path& path, PlyFile& ply, Loading& loading)
      : path_(path), ply_(ply), loading_(loading) {}

  Expected<MeshData> build() {
    read_texture();
    if (const Expected<void> read = elements(); !read) return Unexpected(read.error());
    if (const Expected<void> whole = check_rest(); !whole) return Unexpected(whole.error());
    leave_out_unfit();
    if (!faces_seen_ && !mesh_.positions.empty())
      if (const Expected<void> drawn = points(); !drawn) return Unexpected(drawn.error());
    if (texture_) lost("comment TextureFile", "its texture is left out", "there are no texture coordinates");
    if (textured() && !std::exchange(mesh_.colors, {}).empty())
      lost("", "colours are left out", "its texture gives the colour");
    for (glm::vec3& position : mesh_.positions)  // of vertices that no triangle has
      if (!is_finite(position)) position = glm::vec3(0.0f);
    Material& material = mesh_.materials.emplace_back();
    material.name = "default";
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), glm::vec4(1.0f));
    if (!mesh_.colors.empty() || textured()) material.ambient = material.diffuse = glm::vec3(1.0f);
    if (textured()) make_maps(mesh_, material).base_color.texture = 0;
    mesh_.triangle_materials.assign(mesh_.triangles.size(), 0);
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kRowsBetweenLooks = 4096;

  void lost(const std::string& where, const std::string& what, const std::string& loss) {
    loading_.warnings.add({path_.string(), where, what, loss});
  }

  void leave_out_unfit() {
    std::size_t unfit = 0;
    const auto replace = [&unfit]<class T>(std::vector<T>& values, const T& none) {
      for (T& value : values)
        if (!is_finite(value)) {
          value = none;
          ++unfit;
        }
    };
    replace(mesh_.normals, glm::vec3(0.0f));
    replace(mesh_.colors, glm::vec4(1.0f));
    replace(mesh_.texcoords, glm::vec2(0.0f));
    if (unfit > 0) loading_.warnings.add({path_.string(), "element vertex", kUnfit, kUnfitLost, unfit});
  }

  // Faces that stand before the vertices are read after them.
  Expected<void> elements() {
    const std::vector<PlyElement>& all = ply_.elements();
    const auto vertices_at = std::ranges::find(all, "vertex", &PlyElement::name);
    std::vector<std::pair<const PlyElement*, PlyFile::Place>> waiting;
    for (auto at = all.begin(); at != all.end(); ++at) {
      const bool waits = vertices_at != all.end() && at < vertices_at && of_faces(*at);
      if (waits) waiting.emplace_back(&*at, ply_.place());
      if (const Expected<void> read = waits ? skip(*at) : element(*at); !read) return read;
      if (at != vertices_at) continue;
      const PlyFile::Place behind = ply_.place();
      for (const auto& [faces, place] : waiting) {
        ply_.go_to(place);
        if (const Expected<void> read = element(*faces); !read) return read;
      }
      ply_.go_to(behind);
    }
    return {};
  }
  static bool of_faces(const PlyElement& e) { return e.name == "face" || e.name == "tristrips"; }

  Expected<void> element(const PlyElement& e) {
    return e.name == "vertex"      ? vertices(e)
           : e.name == "face"      ? faces(e)
           : e.name == "tristrips" ? strips(e)
                                   : others(e);
  }

  Expected<void> skip(const PlyElement& element) {
    return rows(element, [](const PlyRow&) -> Expected<void> { return {}; });
  }

  template <class Take>
  Expected<void> rows(const PlyElement& element, Take take) {
    begin_phase(loading_.progress, "mesh", element.count);
    PlyRow row;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (const Expected<void> read = ply_.read_row(element, row); !read) return read;
      if (const Expected<void> taken = take(row); !taken) return taken;
      if (i % kRowsBetweenLooks == kRowsBetweenLooks - 1) advance(loading_.progress, kRowsBetweenLooks);
    }
    return {};
  }

  // A header that does not match its data often yields faces without area, and data after the last row.
  Expected<void> check_rest() {
    const std::size_t left = ply_.bytes_left();
    if (left == 0) return {};
    constexpr std::size_t kOneIn = 4;  // damaged files have at least this share
    if (odd_faces_ > 0 && kOneIn * odd_faces_ >= faces_)
      return ply_.error("its header does not fit its data: " + std::to_string(odd_faces_) + " of " +
                        std::to_string(faces_) + " faces have fewer than three corners or no place, and " +
                        std::to_string(left) + " bytes follow the last one");
    lost("", "bytes follow its last element (" + std::to_string(left) + ")",
         "they are not drawn; does its header count all elements?");
    return {};
  }

  // PLY has no statement for textures; MeshLab names them in a comment.
  void read_texture() {
    if (ply_.textures().empty()) return;
    const std::string& name = ply_.textures().front();
    if (ply_.textures().size() > 1)
      lost("comment TextureFile", "textures after the first are left out", "faces show the first");
    Expected<DecodedImage> image = load_texture(loading_.files.named(name), loading_);
    if (!image)
      return lost("comment TextureFile", "its texture cannot be read: " + image.error().message(),
                  "the plain colour is used");
    if (!image->damage.empty())
      lost("comment TextureFile", "its texture " + name + " is damaged: " + image->damage,
           "part of it is missing");
    texture_ = std::move(image->texture);
  }

  // The mesh gets its texture together with its texture coordinates.
  [[nodiscard]] bool textured() const { return !mesh_.textures.empty(); }
  bool take_texture(const std::string& where) {
    if (texture_) mesh_.textures.edit().push_back(*std::exchange(texture_, std::nullopt));
    if (ply_.textures().empty()) lost(where, "texture coordinates are left out", "it names no texture");
    return textured();
  }

  Expected<void> vertices(const PlyElement& element) {
    const VertexColumns at(element);
    if (!at.positions()) return ply_.error("its vertices have no x, y and z");
    const ColorColumns color(element);
    const bool has_texcoords = at.texcoords() && take_texture("");
    return rows(element, [&](const PlyRow& row) -> Expected<void> {
      mesh_.positions.emplace_back(value(row, at.x[0]), value(row, at.x[1]), value(row, at.x[2]));
      mesh_.normals.push_back(at.normals()
                                  ? glm::vec3(value(row, at.n[0]), value(row, at.n[1]), value(row, at.n[2]))
                                  : glm::vec3(0.0f));
      if (color.there()) mesh_.colors.push_back(color.of(row));
      if (has_texcoords) mesh_.texcoords.emplace_back(value(row, at.uv[0]), 1.0f - value(row, at.uv[1]));
      return {};
    });
  }

  Expected<void> faces(const PlyElement& element) {
    if (element.count == 0) return {};
    const int indices = column(element, {"vertex_indices", "vertex_index"});
    if (indices < 0 || !element.properties[indices].is_list)
      return ply_.error("its faces have no list vertex_indices");
    const ColorColumns color(element);
    const bool colors = color.there() && mesh_.colors.empty();
    if (color.there() && !colors)
      lost("element face", "colours of faces are left out", "its vertices have colours, too");
    int texcoords = column(element, {"texcoord"});
    if (texcoords >= 0 &&
        (!element.properties[texcoords].is_list || !mesh_.texcoords.empty() || !take_texture("element face")))
      texcoords = -1;
    const std::size_t shared = mesh_.positions.size();
    if (colors) mesh_.colors.resize(shared, glm::vec4(1.0f));
    if (texcoords >= 0) mesh_.texcoords.resize(shared, glm::vec2(0.0f));
    taken_.assign(colors || texcoords >= 0 ? shared : 0, false);
    return rows(element, [&](const PlyRow& row) -> Expected<void> {
      corners_ = row.lists[indices];
      for (const double index : corners_)
        if (!(index >= 0.0 && index < shared) || index != std::floor(index)) return no_such_vertex(index);
      for (std::size_t i = 0; !taken_.empty() && i < corners_.size(); ++i) {
        const glm::vec4 painted = colors ? color.of(row) : glm::vec4(1.0f);
        const glm::vec2 texcoord = texcoords < 0 ? glm::vec2(0.0f) : texcoord_of(row, texcoords, i);
        corners_[i] = vertex_of(as_uint32(corners_[i]), colors ? &painted : nullptr,
                                texcoords < 0 ? nullptr : &texcoord);
      }
      polygon();
      return {};
    });
  }

  // Without faces, the vertices are a cloud of points.
  Expected<void> points() {
    if (!loading_.strokes.points.drawn()) {
      loading_.strokes.points.leave_out("element vertex");
      return {};
    }
    const std::size_t count = mesh_.positions.size();
    if (const Expected<void> fits = take_strokes(path_.string(), as_double(count), 0.0, loading_); !fits)
      return fits;
    std::vector<Stroke> strokes(count);
    for (std::uint32_t i = 0; i < count; ++i) strokes[i] = {i, i, true, 0};
    MeshData cloud = std::exchange(mesh_, {});
    mesh_.textures = cloud.textures;
    const AddedStrokes added = add_strokes(strokes, cloud, loading_.strokes, loading_.progress, mesh_);
    warn_of_unplaced(path_.string(), "element vertex", added.unplaced, loading_.warnings);
    return {};
  }

  // A face corner's texture coordinates; zero: the list is too short.
  static glm::vec2 texcoord_of(const PlyRow& row, int list, std::size_t corner) {
    const std::vector<double>& uv = row.lists[list];
    if (2 * corner + 1 >= uv.size()) return glm::vec2(0.0f);
    return {uv[2 * corner], 1.0 - uv[2 * corner + 1]};
  }

  // Colours and texture coordinates of face corners are kept by vertex: a vertex that another face uses with
  // other values is duplicated.
  std::uint32_t vertex_of(std::uint32_t v, const glm::vec4* color, const glm::vec2* texcoord) {
    const bool differs =
        (color && mesh_.colors[v] != *color) || (texcoord && mesh_.texcoords[v] != *texcoord);
    if (taken_[v] && differs) {
      for_each_column([v](auto& column) {
        if (!column.empty()) column.push_back(std::decay_t<decltype(column[v])>(column[v]));
      });
      v = as_uint32(mesh_.positions.size() - 1);
    } else {
      taken_[v] = true;
    }
    if (color) mesh_.colors[v] = *color;
    if (texcoord) mesh_.texcoords[v] = *texcoord;
    return v;
  }

  template <class Use>
  void for_each_column(Use use) {
    use(mesh_.positions), use(mesh_.normals), use(mesh_.colors), use(mesh_.texcoords);
  }

  void polygon() {
    faces_seen_ = true;
    ++faces_;
    if (corners_.size() < 3) {
      ++odd_faces_;
      return lost("element face", "faces of fewer than three corners are left out", "they are not drawn");
    }
    places_.clear();
    for (const double corner : corners_) places_.push_back(mesh_.positions[as_size(corner)]);
    if (!std::ranges::all_of(places_, is_finite<3>)) {
      ++odd_faces_;
      return lost("element face", kUnplaced, kNotDrawn);
    }
    const PolygonTriangles polygon = triangulate(places_);
    if (!polygon.simple)
      lost("element face", "a face crosses itself", "which parts of it are filled is a guess");
    for (const glm::uvec3& t : polygon.triangles)
      mesh_.triangles.emplace_back(corners_[t.x], corners_[t.y], corners_[t.z]);
  }

  [[nodiscard]] Unexpected no_such_vertex(double index) const {
    return ply_.error("a face names vertex " + shortest(index) + ", there are " +
                      std::to_string(mesh_.positions.size()) + ": does its header fit its data?");
  }

  // Strips, separated by -1, as scanned models have them.
  Expected<void> strips(const PlyElement& element) {
    if (element.count == 0) return {};
    const int indices = column(element, {"vertex_indices", "vertex_index"});
    if (indices < 0) return ply_.error("its triangle strips have no list vertex_indices");
    faces_seen_ = true;
    return rows(element, [&](const PlyRow& row) -> Expected<void> {
      const std::vector<double>& list = row.lists[indices];
      std::size_t first = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] < 0.0)
          first = i + 1;
        else if (!(list[i] < mesh_.positions.size()) || list[i] != std::floor(list[i]))
          return no_such_vertex(list[i]);
        if (i < first + 2) continue;
        glm::uvec3 t(list[i - 2], list[i - 1], list[i]);
        if ((i - first) % 2 == 1) std::swap(t.x, t.y);
        if (is_finite(mesh_.positions[t.x]) && is_finite(mesh_.positions[t.y]) &&
            is_finite(mesh_.positions[t.z]))
          mesh_.triangles.push_back(t);
        else
          lost("element tristrips", kUnplaced, kNotDrawn);
      }
      return {};
    });
  }

  Expected<void> others(const PlyElement& element) {
    if (element.count > 0 && !element.properties.empty())
      lost("element " + element.name, "elements other than vertices and faces are left out",
           "they are not drawn");
    return element.properties.empty() ? Expected<void>{} : skip(element);
  }

  const std::filesystem::path& path_;
  PlyFile& ply_;
  Loading& loading_;
  MeshData mesh_;
  std::optional<Texture> texture_;
  std::vector<double> corners_;  // a face's vertices
  std::vector<glm::vec3> places_;
  std::vector<bool> taken_;  // by vertex: a face uses it; empty: face corners have no values of their own
  bool faces_seen_ = false;
  std::size_t faces_ = 0, odd_faces_ = 0;
};

Expected<Scene> load_ply(const std::filesystem::path& path, Loading& loading) {
  Expected<FileBytes> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  Expected<PlyFile> ply = PlyFile::open(path, std::move(*bytes));
  if (!ply) return Unexpected(ply.error());
  Expected<MeshData> mesh = PlyBuilder(path, *ply, loading).build();
  if (!mesh) return Unexpected(mesh.error());
  return Scene(std::move(*mesh));
}

}  // namespace

namespace room {
extern const SceneFormat ply{"PLY", {".ply"}, load_ply, nullptr};
}  // namespace room

}  // namespace pinocchio
