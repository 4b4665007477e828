#include "python/src/scene/make_scene.h"

#include <pinocchio/load.h>

#include <array>
#include <map>

#include "pinocchio/conversion.h"

namespace pinocchio::python {
namespace {

// Makes a material for each different colour of the triangles.
void color_triangles(const std::vector<glm::vec3>& colors, MeshData& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  const std::vector<Material> given = mesh.materials;
  for (std::size_t t = 0; t < colors.size(); ++t) {
    const glm::vec3& c = colors[t];
    const auto [at, is_new] = known.try_emplace({c.x, c.y, c.z}, as_uint32(known.size()));
    mesh.triangle_materials[t] = at->second;
  }
  mesh.materials.assign(known.size(), given.front());
  for (const auto& [color, index] : known)
    mesh.materials[index].ambient = mesh.materials[index].diffuse = {color[0], color[1], color[2]};
}

void add_materials(const std::vector<TexturedMaterial>& materials, MeshData& mesh) {
  for (const TexturedMaterial& m : materials) {
    mesh.materials.push_back(m.material);
    mesh.materials.back().maps = -1;  // of the scene that the material was read from
    if (!m.texture) continue;
    make_maps(mesh, mesh.materials.back()).base_color.texture = as_int(mesh.textures.size());
    mesh.textures.edit().push_back(*m.texture);
  }
  if (mesh.materials.empty()) mesh.materials.emplace_back();
}

void check_rows(std::size_t rows, std::size_t wanted, const char* what, const char* of) {
  if (rows != wanted)
    throw Error(std::string(what) + " has " + std::to_string(rows) + " rows; it needs one for each " + of +
                ", there are " + std::to_string(wanted));
}

// The rows of an array that has one for each vertex or triangle.
template <class To, class T, int... N>
std::vector<To> rows_of(const Like<T, N...>& argument, const char* name, std::size_t wanted, const char* of) {
  const auto array = argument.read(name);
  check_rows(array.shape(0), wanted, name, of);
  return copied<To>(array);
}

}  // namespace

Scene scene_of(const Floats3& vertices, const Words3& triangles, const std::optional<Floats3>& normals,
               const std::optional<Floats2>& uvs, const std::optional<Floats3>& colors,
               const std::vector<TexturedMaterial>& materials, const std::optional<Words>& triangle_materials,
               const Three& ambient) {
  MeshData mesh;
  mesh.positions = copied<glm::vec3>(vertices.read("vertices"));
  mesh.triangles = copied<glm::uvec3>(triangles.read("triangles"));
  const std::size_t n = mesh.positions.size();
  mesh.normals =
      normals ? rows_of<glm::vec3>(*normals, "normals", n, "vertex") : std::vector(n, glm::vec3(0.0f));
  if (uvs) mesh.texcoords = rows_of<glm::vec2>(*uvs, "uvs", n, "vertex");
  mesh.triangle_materials = triangle_materials
                                ? rows_of<std::uint32_t>(*triangle_materials, "triangle_materials",
                                                         mesh.triangles.size(), "triangle")
                                : std::vector<std::uint32_t>(mesh.triangles.size(), 0u);
  add_materials(materials, mesh);
  if (!mesh.textures.empty() && mesh.texcoords.empty())
    throw Error("a material has a texture, but the scene has no uvs; give one (u, v) for each vertex");
  if (colors) {
    const std::vector<glm::vec3> given = copied<glm::vec3>(colors->read("colors"));
    if (given.size() == mesh.positions.size()) {
      for (const glm::vec3& color : given) mesh.colors.emplace_back(color, 1.0f);
    } else {
      check_rows(given.size(), mesh.triangles.size(), "colors", "vertex or triangle");
      color_triangles(given, mesh);
    }
  }
  Scene scene(std::move(mesh));
  scene.ambient_light = ambient.read("ambient");
  (void)value_or_throw(check_scene(scene).map([] { return true; }));
  return scene;
}

}  // namespace pinocchio::python
