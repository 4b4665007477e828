#include <algorithm>
#include <map>

#include "core/scene/input_file.h"
#include "core/scene/loaders.h"
#include "core/scene/mtl_features.h"
#include "core/scene/mtl_materials.h"
#include "core/scene/obj_mesh.h"
#include "core/scene/text_lines.h"

namespace pinocchio {
namespace {

Material default_material(bool colored) {
  Material material;
  if (colored) material.diffuse = material.ambient = glm::vec3(1.0f);  // its vertices say the colour
  material.name = "default";
  return material;
}

// Reads the MTL files that the OBJ names; one that is missing leaves its materials grey.
class MtlLibraries {
 public:
  MtlLibraries(const std::filesystem::path& file, Loading& loading) : file_(file), loading_(loading) {}

  // What follows mtllib: one name, spaces and all, where there is such a file, else several.
  void read(const std::string& names) {
    const std::filesystem::path whole = loading_.files.named(names);
    if (loading_.files.has(whole) || names.find(' ') == std::string::npos) return read_file(whole);
    std::string_view rest = names;
    for (std::string_view name; !(name = next_word(rest)).empty();)
      read_file(loading_.files.named(std::string(name)));
  }

  // An index in `materials`; -1 and a warning where no file explains the name.
  int find(const std::string& name) {
    if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
    loading_.warnings.add(
        {file_.string(), "material '" + name + "'", "materials are in no MTL file", "grey is used"});
    return -1;
  }

  std::vector<MtlMaterial> materials;
  std::vector<std::string> files;  // asked for so far, found or not

 private:
  void read_file(const std::filesystem::path& mtl) {
    files.push_back(mtl.string());
    Expected<FileBytes> bytes = loading_.files.read(mtl, loading_.progress);
    if (!bytes) {
      loading_.warnings.add(
          {file_.string(), "", "its materials cannot be read: " + bytes.error().message(), "grey is used"});
      return;
    }
    FileBytes text = as_utf8(std::move(*bytes));
    join_lines(text);
    add_lost_mtl_features(mtl, text.text(), loading_.warnings);
    for (MtlMaterial& m : read_mtl(text.text())) {
      by_name_.try_emplace(m.name, static_cast<int>(materials.size()));
      materials.push_back(std::move(m));
    }
  }

  const std::filesystem::path& file_;
  Loading& loading_;
  std::map<std::string, int> by_name_;
};

}  // namespace

Expected<Scene> load_obj(const std::filesystem::path& path, Loading& loading) {
  Expected<FileBytes> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  FileBytes text = as_utf8(std::move(*bytes));
  const Expected<ObjText> obj = read_obj_text(text, path, loading.warnings, loading.progress);
  if (!obj) return Unexpected(obj.error());
  MtlLibraries mtl(path, loading);
  for (const std::string& names : obj->libraries) mtl.read(names);

  MeshData mesh;
  mesh.materials.push_back(default_material(!obj->colors.empty()));
  std::vector<std::uint32_t> material_of_name;
  for (const std::string& name : obj->materials)
    material_of_name.push_back(static_cast<std::uint32_t>(mtl.find(name) + 1));
  add_obj_faces(*obj, material_of_name, path, loading, mesh);
  MtlMaterials materials(path, mesh, loading);
  for (const MtlMaterial& m : mtl.materials) mesh.materials.push_back(materials.make(m));
  if (mesh.textures.empty()) mesh.texcoords.clear();
  mtl.files.insert(mtl.files.end(), materials.files().begin(), materials.files().end());
  Scene scene(std::move(mesh));
  scene.source_files = std::move(mtl.files);
  return scene;
}

}  // namespace pinocchio
