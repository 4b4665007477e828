#include <pinocchio/animation.h>
#include <pinocchio/load.h>
#include <pinocchio/names.h>
#include <pinocchio/scene.h>

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "python/src/interrupt.h"
#include "python/src/parts.h"

namespace pinocchio::python {
namespace {

// A material and its texture.
struct TexturedMaterial {
  Material material;
  std::shared_ptr<const Texture> texture;
};

Texture texture_of(const Texels& texels) {
  const std::size_t channels = texels.shape(2);
  if (channels < 3 || channels > 4 || texels.shape(0) == 0 || texels.shape(1) == 0)
    throw Error("a texture is an array (height, width, 3 or 4) of uint8, sRGB");
  Texture texture{"", Image<glm::u8vec4>({texels.shape(1), texels.shape(0)})};
  const std::uint8_t* from = texels.data();
  for (glm::u8vec4& texel : texture.texels.pixels()) {
    texel = {from[0], from[1], from[2], channels == 4 ? from[3] : 255};
    from += channels;
  }
  return texture;
}

Light light_of(std::optional<glm::vec3> position, std::optional<glm::vec3> direction, const glm::vec3& color,
               float intensity, const std::string& falloff, float range, float inner_cone, float outer_cone,
               bool casts_shadow, const std::string& name, float radius, float angle) {
  if (!position && !direction)
    throw Error("a light has a position (a point), a direction (a sun) or both (a spot)");
  if (falloff != "none" && falloff != "inverse_square")
    throw Error("falloff is '" + falloff + "'; it is 'none' or 'inverse_square'");
  if (direction && glm::length(*direction) == 0.0f) throw Error("a light's direction must not be zero");
  Light light;
  light.name = name;
  // The first kind that has what is given: no rectangle.
  const auto* const kind = std::ranges::find_if(kLightKinds, [&](const LightKind& row) {
    return row.has_position == position.has_value() && row.has_direction == direction.has_value();
  });
  light.kind = kind->kind;
  if (position) light.position = *position;
  if (direction) light.direction = glm::normalize(*direction);
  light.color = color;
  light.intensity = intensity;
  light.falloff = falloff == "none" ? Light::Falloff::none : Light::Falloff::inverse_square;
  light.range = range;
  if (kind->has_cone) {
    light.cos_inner = std::cos(glm::radians(inner_cone));
    light.cos_outer = std::cos(glm::radians(outer_cone));
  }
  light.casts_shadow = casts_shadow;
  light.radius = radius;
  light.angle_deg = angle;
  return light;
}

// Makes a material for each different colour of the triangles.
void color_triangles(const std::vector<glm::vec3>& colors, MeshData& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  const std::vector<Material> given = mesh.materials;
  for (std::size_t t = 0; t < colors.size(); ++t) {
    const glm::vec3& c = colors[t];
    const auto [at, is_new] = known.try_emplace({c.x, c.y, c.z}, static_cast<std::uint32_t>(known.size()));
    mesh.triangle_materials[t] = at->second;
  }
  mesh.materials.assign(known.size(), given.front());
  for (const auto& [color, index] : known)
    mesh.materials[index].ambient = mesh.materials[index].diffuse = {color[0], color[1], color[2]};
}

void add_materials(const std::vector<TexturedMaterial>& materials, MeshData& mesh) {
  for (const TexturedMaterial& m : materials) {
    mesh.materials.push_back(m.material);
    if (!m.texture) continue;
    make_maps(mesh, mesh.materials.back()).base_color.texture = static_cast<int>(mesh.textures.size());
    mesh.textures.edit().push_back(*m.texture);
  }
  if (mesh.materials.empty()) mesh.materials.emplace_back();
}

void check_rows(std::size_t rows, std::size_t wanted, const char* what, const char* of) {
  if (rows != wanted)
    throw Error(std::string(what) + " has " + std::to_string(rows) + " rows; it needs one for each " + of +
                ", there are " + std::to_string(wanted));
}

Scene scene_of(const Floats3& vertices, const Words3& triangles, const std::optional<Floats3>& normals,
               const std::optional<Floats2>& uvs, const std::optional<Floats3>& colors,
               const std::vector<TexturedMaterial>& materials, const std::optional<Words>& triangle_materials,
               std::vector<Light> lights, const glm::vec3& ambient) {
  MeshData mesh;
  mesh.positions = copied<glm::vec3>(vertices);
  mesh.triangles = copied<glm::uvec3>(triangles);
  if (normals) check_rows(normals->shape(0), mesh.positions.size(), "normals", "vertex");
  mesh.normals = normals ? copied<glm::vec3>(*normals) : std::vector(mesh.positions.size(), glm::vec3(0.0f));
  if (uvs) {
    check_rows(uvs->shape(0), mesh.positions.size(), "uvs", "vertex");
    mesh.texcoords = copied<glm::vec2>(*uvs);
  }
  if (triangle_materials)
    check_rows(triangle_materials->shape(0), mesh.triangles.size(), "triangle_materials", "triangle");
  mesh.triangle_materials = triangle_materials ? copied<std::uint32_t>(*triangle_materials)
                                               : std::vector<std::uint32_t>(mesh.triangles.size(), 0u);
  add_materials(materials, mesh);
  if (!mesh.textures.empty() && mesh.texcoords.empty())
    throw Error("a material has a texture, but the scene has no uvs; give one (u, v) for each vertex");
  if (colors) {
    const std::vector<glm::vec3> given = copied<glm::vec3>(*colors);
    if (given.size() == mesh.positions.size()) {
      for (const glm::vec3& color : given) mesh.colors.emplace_back(color, 1.0f);
    } else {
      check_rows(given.size(), mesh.triangles.size(), "colors", "vertex or triangle");
      color_triangles(given, mesh);
    }
  }
  Scene scene(std::move(mesh));
  scene.lights = std::move(lights);
  scene.ambient_light = ambient;
  (void)value_or_throw(check_scene(scene).map([] { return true; }));
  return scene;
}

Scene load(const std::filesystem::path& path, bool confine, const std::string& shading) {
  Warnings warnings;
  LoadOptions options;
  options.confine = confine;
  const auto model = parse_name<Shading>(kShadingNames, shading);
  if (!model) throw Error("shading '" + shading + "' is unknown; 'auto' and 'phong' are known");
  options.shading = *model;
  Scene scene = value_or_throw(
      without_gil([&](Progress* progress) { return load_scene(path, options, &warnings, progress); }));
  for (const Warning& warning : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, warning.message().c_str(), 1) != 0) throw nb::python_error();
  return scene;
}

int node_of(const Scene& scene, const std::variant<int, std::string>& name) {
  if (!scene.nodes)
    throw Error("the scene has no nodes to move; load a glTF file, or combine scenes (assemble)");
  if (std::holds_alternative<int>(name)) return std::get<int>(name);
  const int found = scene.nodes->find(std::get<std::string>(name));
  if (found >= 0) return found;
  throw Error("there is no node '" + std::get<std::string>(name) + "'; Scene.nodes lists them");
}

// A scene is copied (cheaply) before it is read without the GIL, because other threads may change it.
Scene with_transforms(const Scene& scene, const nb::dict& transforms) {
  std::vector<NodeTransform> moves;
  for (const auto& [name, matrix] : transforms)
    moves.push_back({node_of(scene, nb::cast<std::variant<int, std::string>>(name)),
                     matrix_of(nb::cast<Matrix>(matrix))});
  return value_or_throw(without_gil([&, copy = scene](Progress*) { return posed(copy, moves); }));
}

Scene assemble(const nb::dict& parts) {
  std::vector<Scene> scenes;
  scenes.reserve(nb::len(parts));
  std::vector<Part> all;
  for (const auto& [name, part] : parts) {
    const bool placed = nb::isinstance<nb::tuple>(part);
    scenes.push_back(nb::cast<Scene>(placed ? nb::object(part[0]) : nb::borrow(part)));
    all.push_back({nb::cast<std::string>(name), scenes.back(),
                   placed ? matrix_of(nb::cast<Matrix>(nb::object(part[1]))) : glm::mat4(1.0f)});
  }
  return value_or_throw(without_gil([&](Progress*) { return assembled(all); }));
}

void bind_material(nb::module_& module) {
  nb::class_<TexturedMaterial>(
      module, "Material",
      "A material of Phong's model with mirrors and glass. Colours are linear, three numbers each.")
      .def(
          "__init__",
          [](TexturedMaterial* self, const glm::vec3& diffuse, const glm::vec3& specular, float shininess,
             const glm::vec3& reflectance, const glm::vec3& transmittance, float ior, bool fresnel,
             const glm::vec3& emission, const std::optional<glm::vec3>& ambient,
             const std::optional<Texels>& texture, const std::string& name, float gloss,
             const glm::vec3& attenuation_color, float attenuation_distance,
             std::optional<bool> double_sided) {
            Material m;
            m.name = name;
            m.ambient = ambient.value_or(diffuse);
            m.diffuse = diffuse;
            m.specular = specular;
            m.shininess = shininess;
            m.reflectance = reflectance;
            m.transmittance = transmittance;
            m.ior = ior;
            m.fresnel = fresnel;
            m.emission = emission;
            m.gloss = gloss;
            m.attenuation_color = attenuation_color;
            m.attenuation_distance = attenuation_distance;
            m.double_sided = double_sided;
            new (self) TexturedMaterial{
                m, texture ? std::make_shared<const Texture>(texture_of(*texture)) : nullptr};
          },
          "diffuse"_a = glm::vec3(0.8f), "specular"_a = glm::vec3(0.0f), "shininess"_a = 1.0f,
          "reflectance"_a = glm::vec3(0.0f), "transmittance"_a = glm::vec3(0.0f), "ior"_a = 1.0f,
          "fresnel"_a = false, "emission"_a = glm::vec3(0.0f), "ambient"_a = nb::none(),
          "texture"_a = nb::none(), "name"_a = "", "gloss"_a = 0.0f, "attenuation_color"_a = glm::vec3(1.0f),
          "attenuation_distance"_a = 0.0f, "double_sided"_a = nb::none(),
          "ambient: None: as diffuse.\n"
          "reflectance: the weight of the mirrored ray; with `fresnel`, at normal incidence.\n"
          "transmittance: the weight of the refracted ray, which is refracted by `ior`.\n"
          "texture: (height, width, 3 or 4) uint8, sRGB. Its colour multiplies diffuse and ambient.\n"
          "gloss: the exponent of the lobe over which samples (spp) spread mirrored rays. 0: sharp.\n"
          "attenuation_color: the share of light that is left after `attenuation_distance` (scene units) "
          "through glass.\n"
          "attenuation_distance: 0: the glass is clear.\n"
          "double_sided: False: the camera sees through the surface from behind, unless backfaces='draw'. "
          "None: "
          "only with backfaces='cull'.\n"
          "Raises Error if the texture has another shape.");
}

void bind_light(nb::module_& module) {
  nb::class_<Light>(module, "Light", "A point light, a sun or a spot light.")
      .def(
          "__init__",
          [](Light* self, std::optional<glm::vec3> position, std::optional<glm::vec3> direction,
             const glm::vec3& color, float intensity, const std::string& falloff, float range,
             float inner_cone, float outer_cone, bool casts_shadow, const std::string& name, float radius,
             float angle) {
            new (self) Light(light_of(position, direction, color, intensity, falloff, range, inner_cone,
                                      outer_cone, casts_shadow, name, radius, angle));
          },
          "position"_a = nb::none(), "direction"_a = nb::none(), "color"_a = glm::vec3(1.0f),
          "intensity"_a = 1.0f, "falloff"_a = "none", "range"_a = std::numeric_limits<float>::infinity(),
          "inner_cone"_a = 0.0f, "outer_cone"_a = 45.0f, "casts_shadow"_a = true, "name"_a = "",
          "radius"_a = 0.0f, "angle"_a = 0.0f,
          "A light with a position is a point light, one with a direction a sun, one with both a spot "
          "light.\n"
          "position, direction: three numbers each; the light travels along the direction.\n"
          "inner_cone, outer_cone: the spot light's cones, in degrees from its direction.\n"
          "falloff: 'none' (the same strength at any distance) or 'inverse_square'.\n"
          "range: no light reaches beyond it, in scene units.\n"
          "casts_shadow: at most eight lights of a scene cast shadows.\n"
          "radius: of the shining sphere, in scene units. angle: the diameter of a sun's disc, in degrees. "
          "With either,\n"
          "several samples (spp) give soft shadows.\n"
          "Raises Error if there is neither position nor direction, or if falloff is another word.")
      .def_prop_ro("kind", [](const Light& light) { return kind_of(light).name; })
      .def_rw("name", &Light::name)
      .def_rw("position", &Light::position)
      .def_prop_rw(
          "direction", [](const Light& l) { return l.direction; },
          [](Light& l, const glm::vec3& d) { l.direction = glm::normalize(d); })
      .def_rw("color", &Light::color)
      .def_rw("intensity", &Light::intensity)
      .def_rw("casts_shadow", &Light::casts_shadow)
      .def_rw("radius", &Light::radius)
      .def_rw("angle", &Light::angle_deg);
}

}  // namespace

void bind_scene(nb::module_& module) {
  bind_material(module);
  bind_light(module);
  nb::class_<Scene>(module, "Scene", "A mesh, which copies share, with lights and cameras.")
      .def(
          "__init__",
          [](Scene* self, const Floats3& vertices, const Words3& triangles,
             const std::optional<Floats3>& normals, const std::optional<Floats2>& uvs,
             const std::optional<Floats3>& colors, const nb::object& materials,
             const std::optional<Words>& triangle_materials, const std::vector<Light>& lights,
             const glm::vec3& ambient) {
            std::vector<TexturedMaterial> all;
            if (nb::isinstance<TexturedMaterial>(materials))
              all.push_back(nb::cast<TexturedMaterial>(materials));
            else if (!materials.is_none())
              for (const nb::handle m : materials) all.push_back(nb::cast<TexturedMaterial>(m));
            new (self) Scene(scene_of(vertices, triangles, normals, uvs, colors, all, triangle_materials,
                                      lights, ambient));
          },
          "vertices"_a, "triangles"_a, "normals"_a = nb::none(), "uvs"_a = nb::none(),
          "colors"_a = nb::none(), "materials"_a = nb::none(), "triangle_materials"_a = nb::none(),
          "lights"_a = std::vector<Light>(), "ambient"_a = glm::vec3(0.1f),
          "vertices: (n, 3) float32, in any unit. triangles: (m, 3) uint32, indices of vertices.\n"
          "normals: (n, 3) float32. None: triangles are flat.\n"
          "uvs: (n, 2) float32. (0, 0) is the texture's first texel.\n"
          "colors: (n, 3) of the vertices or (m, 3) of the triangles, linear. If n equals m, they are the "
          "vertices'.\n"
          "materials: a Material or a list of them. triangle_materials: (m,) uint32, the index of each "
          "triangle's material.\n"
          "A scene without lights is drawn with one above the camera.\n"
          "Raises Error if the numbers of rows do not match or an index is out of range.")
      .def_rw("lights", &Scene::lights, "A copy of the list: assign it again after a change.")
      .def_rw("cameras", &Scene::cameras, "A copy of the list, as for lights.")
      .def_rw("ambient", &Scene::ambient_light)
      .def_ro("source", &Scene::source, "The path of the file that the scene was loaded from.")
      .def_prop_ro("bounds",
                   [](const Scene& s) { return nb::make_tuple(s.mesh->bounds().lo, s.mesh->bounds().hi); })
      .def_prop_ro(
          "vertices",
          [](nb::handle self) {
            const Mesh& mesh = *nb::cast<const Scene&>(self).mesh;
            return view_of<const float>(&mesh.positions.data()->x, {mesh.positions.size(), 3}, self);
          },
          "(n, 3) float32, in world space. The array is not a copy.")
      .def_prop_ro(
          "normals",
          [](nb::handle self) {
            const Mesh& mesh = *nb::cast<const Scene&>(self).mesh;
            return view_of<const float>(&mesh.normals.data()->x, {mesh.normals.size(), 3}, self);
          },
          "(n, 3) float32; 0 where the triangle's own normal is used. The array is not a copy.")
      .def_prop_ro(
          "triangles",
          [](nb::handle self) {
            const Mesh& mesh = *nb::cast<const Scene&>(self).mesh;
            return view_of<const std::uint32_t>(&mesh.triangles.data()->x, {mesh.triangles.size(), 3}, self);
          },
          "(m, 3) uint32. The index of a row is the triangle's id. The array is not a copy.")
      .def_prop_ro(
          "nodes",
          [](const Scene& s) {
            std::vector<std::string> names;
            if (s.nodes)
              for (const Node& node : s.nodes->nodes) names.push_back(node.name);
            return names;
          },
          "The names of the parts that can be moved. The index in the list is the number in `objects`.")
      .def("camera", &camera_for_whole_scene, "A camera that sees the whole scene.")
      .def("posed", &with_transforms, "transforms"_a,
           "The scene with nodes and their children moved.\n"
           "transforms: {name or index: 4x4 matrix from the node to its parent}.\n"
           "Materials, triangles and their ids stay. Lights and cameras move with their nodes.\n"
           "Raises Error if there is no such node, or if a matrix gives numbers that are not finite.")
      .def_prop_ro(
          "duration", [](const Scene& s) { return duration_s(s); },
          "The duration of the scene's animation, in seconds. 0: it has none.")
      .def(
          "at_time",
          [](const Scene& scene, double seconds) {
            return value_or_throw(
                without_gil([copy = scene, seconds](Progress*) { return at_time(copy, seconds); }));
          },
          "seconds"_a,
          "The scene at a time of its animation: its nodes, skins and morph targets, with the lights and "
          "cameras of nodes.\n"
          "seconds: before the first key and after the last one, the scene does not move.\n"
          "Triangles and their ids stay.\n"
          "Raises Error if the time is not finite.")
      .def("__copy__", [](const Scene& scene) { return scene; });
  module.def(
      "load_scene", &load, "path"_a, "confine"_a = false, "shading"_a = "auto",
      "Reads a scene by its extension, as the program does. What is left out of the file is a warning. With\n"
      "confine, files that it names are opened only below its folder, wherever names and links lead.\n"
      "shading: 'auto', the file's reflection model (glTF's for metallic-roughness materials, else Phong's), "
      "or 'phong'.\n"
      "Raises Error if it is another word.");
  module.def("assemble", &assemble, "parts"_a,
             "One scene of several: {name: scene} or {name: (scene, 4x4 matrix)}. Each becomes a node that "
             "can be moved\n"
             "(Scene.posed), with its own nodes below it.");
}

}  // namespace pinocchio::python
