#include "python/src/scene/make_scene.h"

#include <pinocchio/load.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "pinocchio/conversion.h"

namespace pinocchio::python {
namespace {

// Makes a material for each different colour and material of the triangles.
void color_triangles(const std::vector<glm::vec3>& colors, MeshData& mesh) {
  using Key = std::tuple<std::uint32_t, float, float, float>;
  std::map<Key, std::uint32_t> known;
  const std::vector<Material> given = std::exchange(mesh.materials, {});
  for (std::size_t t = 0; t < colors.size(); ++t) {
    std::uint32_t& material = mesh.triangle_materials[t];
    if (material >= given.size())
      throw Error("triangle_materials holds " + std::to_string(material) + "; there are " +
                  std::to_string(given.size()) + " materials");
    const glm::vec3& c = colors[t];
    const auto [at, is_new] = known.try_emplace({material, c.x, c.y, c.z}, as_uint32(known.size()));
    if (is_new) {
      mesh.materials.push_back(given[material]);
      mesh.materials.back().diffuse *= c;
      mesh.materials.back().ambient *= c;
    }
    material = at->second;
  }
}

// Colours that are finite, and no bytes.
std::vector<glm::vec3> colors_of(const Floats3& argument) {
  const auto array = argument.read("colors");
  const float* const begin = array.data();
  const float* const end = begin + array.size();
  const auto* const wrong =
      std::find_if(begin, end, [](float c) { return !(c >= 0.0f && std::isfinite(c)); });
  if (wrong != end) throw Error("colors holds " + shown(*wrong) + "; it needs finite numbers from 0 on");
  if (nb::cast<std::string>(
          nb::module_::import_("numpy").attr("asarray")(argument.source).attr("dtype").attr("kind")) != "f" &&
      std::find_if(begin, end, [](float c) { return c > 1.0f; }) != end)
    throw Error("colors holds whole numbers above 1; it is linear light, of which 1 is white");
  return copied<glm::vec3>(array);
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

template <class Array>
void check_finite(const Array& array, const char* name) {
  const float* const end = array.data() + array.size();
  const float* const wrong = std::find_if(array.data(), end, [](float v) { return !std::isfinite(v); });
  if (wrong == end) return;
  const auto row = as_size(wrong - array.data()) / array.shape(1);
  throw Error(std::string(name) + " holds " + shown(*wrong) + " in row " + std::to_string(row) +
              "; it needs finite numbers");
}

// The rows of an array that has one for each vertex or triangle.
template <class To, class T, int... N>
std::vector<To> rows_of(const Like<T, N...>& argument, const char* name, std::size_t wanted, const char* of) {
  const auto array = argument.read(name);
  check_rows(array.shape(0), wanted, name, of);
  if constexpr (std::is_same_v<T, float>) check_finite(array, name);
  return copied<To>(array);
}

}  // namespace

Scene scene_of(const Floats3& vertices, const Words3& triangles, const std::optional<Floats3>& normals,
               const std::optional<Floats2>& uvs, const std::optional<Floats3>& colors,
               const std::vector<TexturedMaterial>& materials, const std::optional<Words>& triangle_materials,
               const Three& ambient) {
  MeshData mesh;
  const Floats3::Array places = vertices.read("vertices");
  check_finite(places, "vertices");
  mesh.positions = copied<glm::vec3>(places);
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
  if (colors && materials.empty())
    mesh.materials.front().diffuse = mesh.materials.front().ambient = glm::vec3(1.0f);
  if (!mesh.textures.empty() && mesh.texcoords.empty())
    throw Error("a material has a texture, but the scene has no uvs; give one (u, v) for each vertex");
  if (colors) {
    const std::vector<glm::vec3> given = colors_of(*colors);
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
