#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_map>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

#include "core/scene/input_file.h"
#include "core/scene/loaders.h"
#include "core/scene/mtl_features.h"
#include "core/scene/obj_mesh.h"
#include "core/scene/text_lines.h"
#include "core/scene/texture_file.h"

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

Material default_material(bool colored) {
  Material material;
  if (colored) material.diffuse = material.ambient = glm::vec3(1.0f);  // its vertices say the colour
  material.name = "default";
  return material;
}

// Reads the MTL files that the OBJ names; one that is missing leaves its materials grey.
class MtlReader {
 public:
  MtlReader(const std::filesystem::path& file, Loading& loading) : file_(file), loading_(loading) {}

  // What follows mtllib: one name, spaces and all, where there is such a file, else several.
  void read(const std::string& names) {
    const std::filesystem::path whole = named_file(file_, names);
    std::error_code ignored;
    if (std::filesystem::exists(whole, ignored) || names.find(' ') == std::string::npos) return read_file(whole);
    std::string_view rest = names;
    for (std::string_view name; !(name = next_word(rest)).empty();) read_file(named_file(file_, std::string(name)));
  }

  // An index in `materials`; -1 and a warning where no file explains the name.
  int find(const std::string& name) {
    if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
    loading_.warnings.add({file_.string(), "material '" + name + "'", "materials are in no MTL file", "grey is used"});
    return -1;
  }

  std::vector<tinyobj::material_t> materials;
  std::vector<std::string> files;  // asked for so far, found or not

 private:
  void read_file(const std::filesystem::path& mtl) {
    files.push_back(mtl.string());
    Expected<std::string> bytes = read_input_file(mtl, loading_.progress);
    if (!bytes) {
      loading_.warnings.add({file_.string(), "", "its materials cannot be read: " + bytes.error().message(), "grey is used"});
      return;
    }
    std::string text = as_utf8(std::move(*bytes));
    join_lines(text);
    add_lost_mtl_features(mtl, text, loading_.warnings);
    std::replace(text.begin(), text.end(), kJoint, ' ');
    std::replace(text.begin(), text.end(), '\0', ' ');
    std::istringstream lines(text);
    std::string warning, error;
    tinyobj::LoadMtl(&by_name_, &materials, &lines, &warning, &error);
  }

  const std::filesystem::path& file_;
  Loading& loading_;
  std::map<std::string, int> by_name_;
};

// What no statement alone tells: a dissolve that nothing refracts, a texture without coordinates.
void add_lost_materials(const std::vector<tinyobj::material_t>& materials, const MeshData& mesh, const std::filesystem::path& file,
                        Warnings& warnings) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const tinyobj::material_t& m = materials[i];
    const std::string where = "material '" + m.name + "'";
    if (m.dissolve < 1.0f && !mesh.materials[i + 1].transmits())
      warnings.add({file.string(), where, "its d or Tr is left out", "it is opaque"});
    if (!m.diffuse_texname.empty() && mesh.texcoords.empty())
      warnings.add({file.string(), where, "has a texture, and no face has texture coordinates",
                    "the plain colour is used"});
  }
}

void load_textures(const std::vector<tinyobj::material_t>& materials, const std::filesystem::path& file, MeshData& mesh,
                   std::vector<std::string>& source_files, Loading& loading) {
  std::unordered_map<std::string, int> loaded;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    std::string name = materials[i].diffuse_texname;
    if (name.empty() || mesh.texcoords.empty()) continue;
    if (const auto known = loaded.find(name); known != loaded.end()) {
      mesh.materials[i + 1].diffuse_texture = known->second;
      continue;
    }
    const std::filesystem::path texture_file = named_file(file, name);
    source_files.push_back(texture_file.string());
    Expected<DecodedImage> image = load_texture(texture_file, loading);
    const std::string where = "material '" + mesh.materials[i + 1].name + "'";
    if (!image) {
      loading.warnings.add({file.string(), where, "its texture cannot be read: " + image.error().message(),
                            "the plain colour is used"});
      continue;
    }
    if (!image->damage.empty())
      loading.warnings.add({file.string(), where, "its texture " + name + " is damaged: " + image->damage,
                            "part of it may be grey"});
    loaded[name] = mesh.materials[i + 1].diffuse_texture = static_cast<int>(mesh.textures.size());
    mesh.textures.push_back(std::move(image->texture));
  }
}

}  // namespace

Expected<Scene> load_obj(const std::filesystem::path& path, Loading& loading) {
  Expected<std::string> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  std::string text = as_utf8(std::move(*bytes));
  const Expected<ObjText> obj = read_obj_text(text, path, loading.warnings, loading.progress);
  if (!obj) return Unexpected(obj.error());
  MtlReader mtl(path, loading);
  for (const std::string& names : obj->libraries) mtl.read(names);

  MeshData mesh;
  mesh.materials.push_back(default_material(!obj->colors.empty()));
  for (const tinyobj::material_t& m : mtl.materials) mesh.materials.push_back(material_of(m));
  std::vector<std::uint32_t> material_of_name;
  for (const std::string& name : obj->materials) material_of_name.push_back(static_cast<std::uint32_t>(mtl.find(name) + 1));
  add_obj_faces(*obj, material_of_name, path, loading, mesh);
  add_lost_materials(mtl.materials, mesh, path, loading.warnings);
  load_textures(mtl.materials, path, mesh, mtl.files, loading);
  Scene scene(std::move(mesh));
  scene.source_files = std::move(mtl.files);
  return scene;
}

}  // namespace pinocchio
