#include <map>
#include <set>

#include "core/files/input_file.h"
#include "core/files/text_lines.h"
#include "core/scene/formats.h"
#include "core/scene/obj/mesh.h"
#include "core/scene/obj/mtl_features.h"
#include "core/scene/obj/mtl_materials.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

Material default_material(bool colored) {
  Material material;
  if (colored) material.diffuse = material.ambient = glm::vec3(1.0f);  // vertex colours multiply it
  material.name = "default";
  return material;
}

// Reads the MTL files that the OBJ names; the materials of a missing one are grey.
class MtlLibraries {
 public:
  MtlLibraries(const std::filesystem::path& file, Loading& loading) : file_(file), loading_(loading) {}

  // `names` follow mtllib: one or several, each of which may hold spaces.
  void read(std::string_view names) {
    if (names.size() > 1 && names.starts_with('"') && names.ends_with('"'))
      names = names.substr(1, names.size() - 2);
    if (is_file(names)) return read_file(loading_.files.named(std::string(names)));
    for (names = trimmed(names); !names.empty(); names = trimmed(names)) {
      const std::string_view name = first_name(names);
      read_file(loading_.files.named(std::string(name)));
      names.remove_prefix(name.size());
    }
  }

  // The material's index; -1 and a warning: no file defines the name.
  int find(const std::string& name) {
    const std::string bare(without_comment(name));
    for (const auto& [names, wanted] :
         {std::pair(&by_name_, name), {&by_name_, bare}, {&by_bare_name_, bare}})
      if (const auto found = names->find(wanted); found != names->end()) return found->second;
    loading_.warnings.add(
        {file_.string(), "material '" + name + "'", "materials are in no MTL file", "grey is used"});
    return -1;
  }

  std::vector<MtlMaterial> materials;
  std::vector<std::string> files;  // named so far, found or not

 private:
  [[nodiscard]] bool is_file(std::string_view name) const {
    return loading_.files.has(loading_.files.named(std::string(name)));
  }

  // The largest number of words, up to a limit, that name an existing file together. Where none do: all words
  // up to the first that ends with .mtl.
  [[nodiscard]] std::string_view first_name(std::string_view names) const {
    constexpr int kMostWords = 8;
    std::string_view rest = names, found, ended;
    for (int words = 1; !next_word(rest).empty(); ++words) {
      if (words > kMostWords && !(found.empty() && ended.empty())) break;
      const std::string_view name = names.substr(0, names.size() - rest.size());
      if (words <= kMostWords && is_file(name)) found = name;
      if (ended.empty() && (name.ends_with(".mtl") || name.ends_with(".MTL"))) ended = name;
    }
    return !found.empty() ? found : !ended.empty() ? ended : names;
  }

  void read_file(const std::filesystem::path& mtl) {
    if (!read_.insert(mtl.string()).second) return;
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
    MtlFile read = read_mtl(text.text());
    if (!read.opacity_reason.empty())
      loading_.warnings.add({mtl.string(), "", "Tr is read as opacity: " + read.opacity_reason,
                             "write d where Tr should make materials transparent"});
    for (MtlMaterial& m : read.materials) {
      by_name_.try_emplace(m.name, as_int(materials.size()));
      by_bare_name_.try_emplace(std::string(without_comment(m.name)), as_int(materials.size()));
      materials.push_back(std::move(m));
    }
  }

  const std::filesystem::path& file_;
  Loading& loading_;
  std::map<std::string, int> by_name_, by_bare_name_;  // with and without a comment behind it
  std::set<std::string> read_;                         // `files`, to find them
};

Expected<Scene> load_obj(const std::filesystem::path& path, Loading& loading) {
  Expected<FileBytes> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  FileBytes text = as_utf8(std::move(*bytes));
  const Expected<ObjText> obj = read_obj_text(text, path, loading);
  if (!obj) return Unexpected(obj.error());
  MtlLibraries mtl(path, loading);
  for (const std::string& names : obj->libraries) mtl.read(names);

  MeshData mesh;
  mesh.materials.push_back(default_material(!obj->colors.empty()));
  std::vector<std::uint32_t> material_of_name;
  for (const std::string& name : obj->materials) material_of_name.push_back(as_uint32(mtl.find(name) + 1));
  add_obj_faces(*obj, material_of_name, path, loading, mesh);
  if (const Expected<void> added = add_obj_strokes(*obj, material_of_name, path, loading, mesh); !added)
    return Unexpected(added.error());
  MtlMaterials materials(path, mesh, loading);
  for (const MtlMaterial& m : mtl.materials) mesh.materials.push_back(materials.make(m));
  if (mesh.textures.empty()) mesh.texcoords.clear();
  mtl.files.insert(mtl.files.end(), materials.files().begin(), materials.files().end());
  Scene scene(std::move(mesh));
  scene.source_files = std::move(mtl.files);
  return scene;
}

}  // namespace

namespace room {
extern const SceneFormat obj{"OBJ", {".obj"}, load_obj, save_obj, obj_files};
}  // namespace room

}  // namespace pinocchio
