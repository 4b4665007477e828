#include <array>
#include <cstdio>
#include <string>

#include "core/image/atomic_file.h"
#include "pinocchio/save.h"

namespace pinocchio {
namespace {

constexpr std::size_t kTrianglesBetweenLooks = 1 << 16;

// Nine digits bring every float back to the last bit.
void add_vec3(std::string& text, const char* keyword, const glm::vec3& v) {
  std::array<char, 96> line{};
  std::snprintf(line.data(), line.size(), "%s %.9g %.9g %.9g\n", keyword, static_cast<double>(v.x),
                static_cast<double>(v.y), static_cast<double>(v.z));
  text += line.data();
}

void add_number(std::string& text, const char* keyword, float value) {
  std::array<char, 48> line{};
  std::snprintf(line.data(), line.size(), "%s %.9g\n", keyword, static_cast<double>(value));
  text += line.data();
}

std::string material_name(std::size_t i, const Material& m) {
  std::string name = m.name.empty() ? "material" : m.name;
  for (char& c : name)
    if (c == ' ' || c == '\t') c = '_';
  return std::to_string(i) + "_" + name;  // MTL tells materials apart by name alone
}

std::string mtl_text(const Mesh& mesh) {
  std::string text = "# Pinocchio\n";
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& m = mesh.materials[i];
    text += "\nnewmtl " + material_name(i, m) + "\n";
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
      // One Ks serves highlight and mirror.
      add_vec3(text, "Ks", m.reflects() ? m.reflectance : m.specular);
      text += m.reflects() ? (m.fresnel ? "illum 5\n" : "illum 3\n") : "illum 2\n";
    }
  }
  return text;
}

std::string obj_text(const Mesh& mesh, const std::string& mtl_name, const Progress* progress) {
  std::string text = "# Pinocchio\nmtllib " + mtl_name + "\n";
  throw_if_cancelled(progress);
  for (const glm::vec3& p : mesh.positions) add_vec3(text, "v", p);
  for (const glm::vec3& n : mesh.normals) add_vec3(text, "vn", n);
  std::uint32_t material = 0xffffffffu;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i % kTrianglesBetweenLooks == 0) throw_if_cancelled(progress);
    if (mesh.triangle_materials[i] != material) {
      material = mesh.triangle_materials[i];
      text += "usemtl " + material_name(material, mesh.materials[material]) + "\n";
    }
    text += "f";
    for (int c = 0; c < 3; ++c) {
      const std::string vertex = std::to_string(mesh.triangles[i][c] + 1);
      text += " " + vertex + "//" + vertex;
    }
    text += "\n";
  }
  return text;
}

}  // namespace

void save_obj(const Scene& scene, const std::filesystem::path& file, Progress* progress) {
  std::filesystem::path mtl = file;
  mtl.replace_extension(".mtl");
  check_writable(mtl);
  const std::string text = obj_text(*scene.mesh, mtl.filename().string(), progress);
  // Both are whole before either gets its name.
  write_text(file, text, progress, [&] { write_text(mtl, mtl_text(*scene.mesh)); });
}

}  // namespace pinocchio
