#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <streambuf>
#include <tuple>
#include <unordered_map>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

#include "core/scene/obj_check.h"
#include "core/scene/read_bytes.h"
#include "core/scene/texture_file.h"
#include "pinocchio/load.h"

namespace pinocchio {
namespace {

glm::vec3 vec3_of(const float* v) {
  return {v[0], v[1], v[2]};
}

// MTL's illumination models: 2 highlight, 3 mirror, 4 glass, 5 Fresnel mirror, 6 refraction, 7 refraction
// with Fresnel. Exporters write 4, 6 and 7 for plain materials too: only what has an index of refraction
// and lets light through (Tf above 0, or d below 1) refracts.
Material material_of(const tinyobj::material_t& m) {
  Material material;
  material.name = m.name;
  material.diffuse = vec3_of(m.diffuse);
  material.ambient = vec3_of(m.ambient);
  if (material.ambient == glm::vec3(0.0f)) material.ambient = material.diffuse;  // Ka is seldom written
  material.specular = m.illum >= 2 ? vec3_of(m.specular) : glm::vec3(0.0f);
  material.shininess = std::max(m.shininess, 1.0f);
  material.emission = vec3_of(m.emission);

  const glm::vec3 filter = vec3_of(m.transmittance);
  const bool refracting_model = m.illum == 4 || m.illum == 6 || m.illum == 7;
  const bool lets_light_through = filter != glm::vec3(0.0f) || m.dissolve < 1.0f;
  if (refracting_model && m.ior > 1.0f && lets_light_through) {
    material.ior = m.ior;
    material.transmittance = filter != glm::vec3(0.0f) ? filter : glm::vec3(1.0f - m.dissolve);
  } else if (m.illum == 3 || m.illum == 5) {
    material.reflectance = vec3_of(m.specular);
    material.fresnel = m.illum == 5;
  }
  return material;
}

Material default_material() {
  Material material;
  material.name = "default";
  return material;
}

// The whole rest of every mtllib line: the parser cuts names at their spaces.
std::vector<std::string> mtllib_names(const std::string& text) {
  constexpr std::string_view kKeyword = "mtllib ";
  std::vector<std::string> names;
  for (std::size_t at = text.find(kKeyword); at != std::string::npos; at = text.find(kKeyword, at)) {
    at += kKeyword.size();
    names.push_back(text.substr(at, std::min(text.find_first_of("\r\n", at), text.size()) - at));
  }
  return names;
}

// Reads the MTL files that the OBJ names; one that is missing leaves its materials grey.
class MtlReader final : public tinyobj::MaterialReader {
 public:
  MtlReader(const std::filesystem::path& file, std::vector<std::string> full_names, Warnings& warnings)
      : file_(file), full_names_(std::move(full_names)), warnings_(warnings) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* by_name, std::string* warning, std::string* error) override {
    std::filesystem::path mtl = file_.parent_path() / name;
    std::ifstream in(mtl);
    for (const std::string& full_name : full_names_)
      if (!in.is_open() && full_name.starts_with(name)) {
        mtl = file_.parent_path() / full_name;
        in.clear();
        in.open(mtl);
      }
    files_.push_back(mtl.string());
    if (!in) {
      warnings_.push_back(file_.string() + ": its materials " + mtl.string() +
                          " cannot be read; grey is used");
      return false;
    }
    tinyobj::LoadMtl(by_name, materials, &in, warning, error);
    return true;
  }

  // Asked for so far, found or not.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  const std::filesystem::path& file_;
  std::vector<std::string> files_;
  std::vector<std::string> full_names_;
  Warnings& warnings_;
};

// Text that a parser reads, piece by piece: between two it may be told to end.
class WatchedText final : public std::streambuf {
 public:
  WatchedText(std::string& text, Progress* progress) : left_(text), progress_(progress) {
    begin_phase(progress, "read", static_cast<double>(text.size()));
    setg(text.data(), text.data(), text.data());
  }

 private:
  int_type underflow() override {
    constexpr std::size_t kAtOnce = 1 << 20;
    const std::span<char> piece = left_.first(std::min(kAtOnce, left_.size()));
    advance(progress_, static_cast<double>(piece.size()));
    left_ = left_.subspan(piece.size());
    setg(piece.data(), piece.data(), piece.data() + piece.size());
    return piece.empty() ? traits_type::eof() : traits_type::to_int_type(piece.front());
  }

  std::span<char> left_;
  Progress* progress_;
};

// What of the parser's warnings matters: materials that no MTL file explains.
void add_unknown_materials(const std::string& parser_warnings, const std::filesystem::path& file,
                           Warnings& warnings) {
  std::istringstream lines(parser_warnings);
  for (std::string line; std::getline(lines, line);) {
    const std::string warning = file.string() + ": " + line + "; grey is used";
    if (line.starts_with("material [") &&
        std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  }
}

struct ObjFile {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
};

// One vertex of ours stands for one combination of position, normal, texture coordinate and, where
// normals are made from a smoothing group, that group.
class ObjMesh {
 public:
  ObjMesh(const ObjFile& obj, Progress* progress) : obj_(obj), progress_(progress) {
    mesh_.materials.push_back(default_material());
    for (const tinyobj::material_t& m : obj.materials) mesh_.materials.push_back(material_of(m));
  }

  MeshData build() {
    std::size_t faces = 0;
    for (const tinyobj::shape_t& shape : obj_.shapes) faces += shape.mesh.num_face_vertices.size();
    begin_phase(progress_, "mesh", static_cast<double>(faces));
    for (const tinyobj::shape_t& shape : obj_.shapes) {
      const tinyobj::mesh_t& mesh = shape.mesh;
      for (std::size_t face = 0; face < mesh.num_face_vertices.size(); ++face) {
        const unsigned group = face < mesh.smoothing_group_ids.size() ? mesh.smoothing_group_ids[face] : 0;
        add_triangle(&mesh.indices[3 * face], group, mesh.material_ids[face]);
        if (face % kFacesBetweenLooks == kFacesBetweenLooks - 1) advance(progress_, kFacesBetweenLooks);
      }
    }
    for (const std::uint32_t vertex : smooth_vertices_)
      if (glm::vec3& n = mesh_.normals[vertex]; n != glm::vec3(0.0f)) n = glm::normalize(n);
    if (!any_texcoord_) mesh_.texcoords.clear();
    return std::move(mesh_);
  }

 private:
  using Key = std::tuple<int, int, int, unsigned>;
  static constexpr int kFacesBetweenLooks = 4096;

  void add_triangle(const tinyobj::index_t* corners, unsigned group, int material) {
    glm::uvec3 triangle;
    for (int i = 0; i < 3; ++i) triangle[i] = vertex_of(corners[i], group);
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_materials.push_back(static_cast<std::uint32_t>(material + 1));
    if (group == 0) return;
    const glm::vec3 a = mesh_.positions[triangle.x];
    const glm::vec3 n = glm::cross(mesh_.positions[triangle.y] - a, mesh_.positions[triangle.z] - a);
    for (int i = 0; i < 3; ++i)
      if (corners[i].normal_index < 0) mesh_.normals[triangle[i]] += n;  // weighed by area
  }

  std::uint32_t vertex_of(const tinyobj::index_t& corner, unsigned group) {
    const bool smooth = corner.normal_index < 0 && group > 0;
    const Key key{corner.vertex_index, corner.normal_index, corner.texcoord_index, smooth ? group : 0};
    const auto [at, is_new] = vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return at->second;
    const tinyobj::attrib_t& a = obj_.attributes;
    mesh_.positions.push_back(vec3_of(&a.vertices[3 * static_cast<std::size_t>(corner.vertex_index)]));
    mesh_.normals.push_back(corner.normal_index < 0
                                ? glm::vec3(0.0f)
                                : vec3_of(&a.normals[3 * static_cast<std::size_t>(corner.normal_index)]));
    if (smooth) smooth_vertices_.push_back(at->second);
    glm::vec2 texcoord(0.0f);
    if (corner.texcoord_index >= 0) {
      const float* t = &a.texcoords[2 * static_cast<std::size_t>(corner.texcoord_index)];
      texcoord = {t[0], 1.0f - t[1]};  // OBJ's v grows upwards
      any_texcoord_ = true;
    }
    mesh_.texcoords.push_back(texcoord);
    return at->second;
  }

  const ObjFile& obj_;
  Progress* progress_;
  MeshData mesh_;
  std::map<Key, std::uint32_t> vertices_;
  std::vector<std::uint32_t> smooth_vertices_;
  bool any_texcoord_ = false;
};

void load_textures(const ObjFile& obj, const std::filesystem::path& file, MeshData& mesh,
                   std::vector<std::string>& source_files, Warnings& warnings) {
  std::unordered_map<std::string, int> loaded;
  for (std::size_t i = 0; i < obj.materials.size(); ++i) {
    std::string name = obj.materials[i].diffuse_texname;
    std::replace(name.begin(), name.end(), '\\', '/');  // from Windows
    if (name.empty() || mesh.texcoords.empty()) continue;
    if (const auto known = loaded.find(name); known != loaded.end()) {
      mesh.materials[i + 1].diffuse_texture = known->second;
      continue;
    }
    const std::filesystem::path texture_file = file.parent_path() / name;
    source_files.push_back(texture_file.string());
    std::optional<Texture> texture = load_texture(texture_file);
    if (!texture) {
      warnings.push_back(file.string() + ": its texture " + name +
                         " cannot be read; the plain colour is used");
      continue;
    }
    loaded[name] = mesh.materials[i + 1].diffuse_texture = static_cast<int>(mesh.textures.size());
    mesh.textures.push_back(std::move(*texture));
  }
}

}  // namespace

Expected<Scene> load_obj(const std::filesystem::path& path, Warnings& warnings, Progress* progress) {
  std::optional<std::string> text = read_bytes(path, progress);
  if (!text) return Unexpected(InputError{path.string(), 0, "cannot be read", "is it yours to read?"});
  if (const Expected<void> checked = check_obj_text(*text, path, progress); !checked)
    return Unexpected(checked.error());

  ObjFile obj;
  MtlReader mtl(path, mtllib_names(*text), warnings);
  WatchedText watched(*text, progress);
  std::istream stream(&watched);
  std::string warning, error;
  constexpr bool kTriangulate = true, kVertexColors = false;
  if (!tinyobj::LoadObj(&obj.attributes, &obj.shapes, &obj.materials, &warning, &error, &stream, &mtl,
                        kTriangulate, kVertexColors))
    return Unexpected(
        InputError{path.string(), 0, error.substr(0, error.find('\n')), "export the file again"});
  add_unknown_materials(warning, path, warnings);
  MeshData mesh = ObjMesh(obj, progress).build();
  std::vector<std::string> source_files = mtl.files();
  load_textures(obj, path, mesh, source_files, warnings);
  Scene scene(std::move(mesh));
  scene.source_files = std::move(source_files);
  return scene;
}

}  // namespace pinocchio
