#include <map>
#include <string>
#include <vector>

#include "core/base/decimal.h"
#include "core/files/atomic_file.h"
#include "core/image/codecs/png.h"
#include "core/image/tonemap.h"
#include "core/scene/formats.h"
#include "pinocchio/save.h"

namespace pinocchio {
namespace {

constexpr std::size_t kTrianglesBetweenLooks = 1 << 16;

// Nine digits restore every float exactly.
void add_number(std::string& text, const char* keyword, float value) {
  text += std::string(keyword) + " " + decimal(value, 9) + "\n";
}

void add_vec3(std::string& text, const char* keyword, const glm::vec3& v) {
  text += keyword;
  for (int c = 0; c < 3; ++c) text += " " + decimal(v[c], 9);
  text += "\n";
}

std::string material_name(std::size_t i, const Material& m) {
  std::string name = m.name.empty() ? "material" : m.name;
  for (char& c : name)
    if (c == ' ' || c == '\t') c = '_';
  return std::to_string(i) + "_" + name;  // MTL identifies materials by name alone
}

std::filesystem::path mtl_file(std::filesystem::path file) {
  return file.replace_extension(".mtl");
}

std::filesystem::path texture_file(const std::filesystem::path& file, std::size_t texture) {
  return file.parent_path() / (file.stem().string() + "-" + std::to_string(texture) + ".png");
}

// The texts of both files, and the textures saved beside them.
class ObjWriter {
 public:
  ObjWriter(const Mesh& mesh, const std::filesystem::path& file, Warnings& warnings)
      : mesh_(mesh), file_(file), warnings_(warnings) {
    for (const Material& m : mesh.materials)
      if (const MaterialMaps* maps = maps_of(m)) {
        has_colors_ = has_colors_ || maps->vertex_colors;
        has_texcoords_ = has_texcoords_ || maps->base_color.used() || maps->normal.used() ||
                         maps->emissive.used() || maps->alpha.used();
      }
    has_colors_ = has_colors_ && !mesh.colors.empty();
    has_texcoords_ = has_texcoords_ && !mesh.texcoords.empty();
  }

  std::string mtl() {
    std::string text = "# Pinocchio\n";
    for (std::size_t i = 0; i < mesh_.materials.size(); ++i) {
      const Material& m = mesh_.materials[i];
      text += "\nnewmtl " + material_name(i, m) + "\n";
      add_phong(m, text);
      if (m.attenuates())
        warnings_.add({file_.string(), "material '" + m.name + "'", "the colour of its volume is left out",
                       "thick glass is as clear as thin glass"});
      if (const MaterialMaps* maps = maps_of(m)) add_maps(m, *maps, text);
    }
    return text;
  }

  std::string obj(const std::string& mtl_name, const Progress* progress) {
    std::string text = "# Pinocchio\nmtllib " + mtl_name + "\n";
    throw_if_cancelled(progress);
    add_vertices(text);
    std::uint32_t material = 0xffffffffu;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (i % kTrianglesBetweenLooks == 0) throw_if_cancelled(progress);
      if (mesh_.triangle_materials[i] != material) {
        material = mesh_.triangle_materials[i];
        text += "usemtl " + material_name(material, mesh_.materials[material]) + "\n";
      }
      text += "f";
      for (int c = 0; c < 3; ++c) add_corner(mesh_.triangles[i][c], text);
      text += "\n";
    }
    return text;
  }

  void write_textures() const {
    for (const auto& [texture, name] : texture_files_)
      write_text(file_.parent_path() / name, encode_png(mesh_.textures[texture].image()));
  }

 private:
  [[nodiscard]] const MaterialMaps* maps_of(const Material& m) const {
    return m.maps < 0 ? nullptr : &mesh_.maps[m.maps];
  }

  static void add_phong(const Material& m, std::string& text) {
    add_vec3(text, "Ka", m.ambient);
    add_vec3(text, "Kd", m.diffuse);
    add_number(text, "Ns", m.shininess);
    if (m.emission != glm::vec3(0.0f)) add_vec3(text, "Ke", m.emission);
    if (m.transmits()) {
      add_vec3(text, "Ks", m.specular);
      add_vec3(text, "Tf", m.transmittance);
      add_number(text, "Ni", m.ior);
      text += "illum 7\n";
    } else {
      // MTL has one Ks for highlight and mirror.
      add_vec3(text, "Ks", m.reflects() ? m.reflectance : m.specular);
      text += m.reflects() ? (m.fresnel ? "illum 5\n" : "illum 3\n") : "illum 2\n";
    }
  }

  void add_maps(const Material& m, const MaterialMaps& maps, std::string& text) {
    const auto lost = [&](const char* what, const char* loss) {
      warnings_.add({file_.string(), "material '" + m.name + "'", what, loss});
    };
    add_texture("map_Kd", "", maps.base_color, lost, text);
    add_texture("map_Ke", "", maps.emissive, lost, text);
    add_texture("norm", "", maps.normal, lost, text);
    if (maps.normal.used() && maps.normal_scale != 1.0f)
      lost("the scale of its normal map is left out", "its bumps have another height");
    if (maps.alpha_mode != AlphaMode::opaque) {
      constexpr const char* kChannels[] = {" -imfchan r", " -imfchan g", " -imfchan b", " -imfchan m"};
      add_texture("map_d", kChannels[maps.alpha_channel], maps.alpha, lost, text);
      add_number(text, "d", maps.alpha_factor);
      if (maps.alpha_mode == AlphaMode::mask)
        lost("its alpha cutoff is left out", "its holes are drawn half transparent, by their alpha");
    }
    if (maps.metallic_roughness.used())
      lost("its metallic-roughness texture is left out", "all of it has one metalness and one roughness");
    if (maps.maps_dielectric())
      lost("its specular and transmission textures are left out",
           "its highlights and its transparency are the same everywhere");
    if (maps.maps_layers())
      lost("the textures of its clear coat and sheen are left out",
           "its coat and sheen are the same everywhere");
    if (maps.occlusion.used()) lost("its occlusion texture is left out", "its hollows are not darkened");
  }

  template <class Lost>
  void add_texture(const char* keyword, const char* option, const TextureUse& use, const Lost& lost,
                   std::string& text) {
    if (!use.used() || !has_texcoords_) return;
    if (use.uv_set != 0) lost("a texture on the second set of coordinates is left out", "it is missing");
    if (use.uv_set != 0) return;
    const glm::mat3x2& t = use.uv_from_texcoord;
    if (t[0].y != 0.0f || t[1].x != 0.0f) lost("the rotation of a texture is left out", "it lies unrotated");
    if (use.nearest) lost("textures without interpolation are interpolated", "their texels are blurred");
    if (use.wrap_u != use.wrap_v || use.wrap_u == Wrap::mirror)
      lost("the wrap mode of a texture is left out", "it is repeated there");
    const std::string name = texture_file(file_, as_size(use.texture)).filename().string();
    texture_files_.try_emplace(use.texture, name);
    text += keyword + std::string(option);
    if (t[0].x != 1.0f || t[1].y != 1.0f) text += " -s " + number(t[0].x) + " " + number(t[1].y) + " 1";
    if (const float v = 1.0f - t[1].y - t[2].y; t[2].x != 0.0f || v != 0.0f)  // MTL's v points up
      text += " -o " + number(t[2].x) + " " + number(v) + " 0";
    if (use.wrap_u == Wrap::clamp && use.wrap_v == Wrap::clamp) text += " -clamp on";
    text += " " + name + "\n";
  }

  static std::string number(float value) {
    std::string text;
    add_number(text, "", value);
    return text.substr(1, text.size() - 2);
  }

  void add_vertices(std::string& text) {
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      add_vec3(text, "v", mesh_.positions[i]);
      if (!has_colors_) continue;
      const glm::vec4& c = mesh_.colors[i];
      text.pop_back();
      add_vec3(text, "", {linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b)});
      if (c.a != 1.0f)
        warnings_.add({file_.string(), "", "the alpha of vertices is left out", "they are opaque"});
    }
    if (has_texcoords_)
      for (const glm::vec2& t : mesh_.texcoords)
        text += "vt " + number(t.x) + " " + number(1.0f - t.y) + "\n";
    normals_.reserve(mesh_.normals.size());
    std::size_t count = 0;
    for (const glm::vec3& n : mesh_.normals) {
      const bool given = n != glm::vec3(0.0f);  // else the triangle's normal
      if (given) add_vec3(text, "vn", n);
      normals_.push_back(given ? ++count : 0);
    }
  }

  void add_corner(std::uint32_t vertex, std::string& text) const {
    const std::string index = std::to_string(vertex + 1);
    text += " " + index;
    if (has_texcoords_ || normals_[vertex] > 0) text += "/";
    if (has_texcoords_) text += index;
    if (normals_[vertex] > 0) text += "/" + std::to_string(normals_[vertex]);
  }

  const Mesh& mesh_;
  const std::filesystem::path& file_;
  Warnings& warnings_;
  bool has_colors_ = false, has_texcoords_ = false;
  std::vector<std::size_t> normals_;          // of each vertex, counted from 1; 0: none
  std::map<int, std::string> texture_files_;  // by texture
};

}  // namespace

void save_obj(const Scene& scene, const std::filesystem::path& file, Progress* progress, Warnings* warnings) {
  const std::filesystem::path mtl = mtl_file(file);
  check_writable(mtl);
  Warnings unheard;
  Warnings& heard = warnings ? *warnings : unheard;
  if (scene.animation) heard.add({file.string(), "", "animations are left out", "everything stands still"});
  ObjWriter writer(*scene.mesh, file, heard);
  const std::string text = writer.obj(mtl.filename().string(), progress), materials = writer.mtl();
  // All files are complete before any gets its final name.
  write_text(file, text, progress, [&] {
    writer.write_textures();
    write_text(mtl, materials);
  });
}

SavedFiles obj_files(const Scene& scene, const std::filesystem::path& file) {
  SavedFiles files{file, mtl_file(file)};
  for (std::size_t i = 0; i < scene.mesh->textures.size(); ++i) files.push_back(texture_file(file, i));
  return files;
}

}  // namespace pinocchio
