#include <pinocchio/load.h>
#include <pinocchio/names.h>
#include <pinocchio/scene.h>

#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "pinocchio/conversion.h"
#include "python/src/scene/environment.h"
#include "python/src/scene/make_scene.h"
#include "python/src/scene/pickle.h"
#include "python/src/support/interrupt.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

// The objects of a list, each of which is a T.
template <class T>
std::vector<T> all_of(nb::handle list, const std::string& name, const char* wanted) {
  std::vector<T> values;
  for (const nb::handle item : nb::cast<nb::iterable>(nb::borrow(list))) {
    if (!nb::isinstance<T>(item))
      throw Error(name + "[" + std::to_string(values.size()) + "] is a " +
                  nb::cast<std::string>(item.type().attr("__name__")) + "; it must be a " + wanted);
    values.push_back(nb::cast<T>(item));
  }
  return values;
}

float diameter(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(as_float(value)))
    throw Error(std::string(name) + " is a diameter in scene units; it must be finite and not negative");
  return as_float(value);
}

PyScene load(const std::filesystem::path& path, bool confine, const std::string& shading,
             const std::variant<int, std::string>& animation, const std::string& up_axis, double point_size,
             double line_width, const std::string& variant, std::uint64_t load_limit_mib) {
  Warnings warnings;
  LoadOptions options;
  options.confine = confine;
  const auto model = parse_name<Shading>(kShadingNames, shading);
  if (!model) throw Error("shading '" + shading + "' is unknown; 'auto' and 'phong' are known");
  options.shading = *model;
  const int* const number = std::get_if<int>(&animation);
  options.animation = number ? std::to_string(*number) : std::get<std::string>(animation);
  const auto axis = parse_name<UpAxis>(kUpAxisNames, up_axis);
  if (!axis) throw Error("up_axis is '" + up_axis + "'; it is 'y' or 'z'");
  options.up_axis = *axis;
  options.point_size = diameter("point_size", point_size);
  options.line_width = diameter("line_width", line_width);
  options.variant = variant;
  options.limit_bytes = std::min(load_limit_mib, ~std::uint64_t{0} >> 20) << 20;
  Scene scene = value_or_throw(
      without_gil([&](Progress* progress) { return load_scene(path, options, &warnings, progress); }));
  warn_of(warnings);
  return PyScene(std::move(scene));
}

PyScene assemble(const Dict& given) {
  const nb::dict parts = given.read("parts");
  std::vector<Scene> scenes;
  scenes.reserve(nb::len(parts));
  std::vector<Part> all;
  for (const auto& [name, part] : parts) {
    const bool placed = nb::isinstance<nb::tuple>(part);
    std::string named;
    if (!nb::try_cast(name, named))
      throw Error("a part is named " + std::string(nb::repr(name).c_str()) + "; its name is a text");
    if (placed && nb::len(part) != 2)
      throw Error("the part '" + named + "' must be a scene, or (scene, 4x4 matrix)");
    const nb::object scene = placed ? nb::object(part[0]) : nb::borrow(part);
    if (!nb::isinstance<PyScene>(scene))
      throw Error("the part '" + named + "' must be a scene, or (scene, 4x4 matrix)");
    scenes.push_back(nb::cast<const PyScene&>(scene).now());
    all.push_back({named, scenes.back(),
                   placed ? Matrix{part[1]}.read("the matrix of '" + named + "'") : glm::mat4(1.0f)});
  }
  return PyScene(value_or_throw(without_gil([&](Progress*) { return assembled(all); })));
}

std::vector<TexturedMaterial> materials_of(const Mesh& mesh) {
  std::vector<TexturedMaterial> all;
  for (const Material& material : mesh.materials) {
    all.push_back({material, nullptr});
    if (material.maps < 0) continue;
    const TextureUse& use = mesh.maps[as_size(material.maps)].base_color;
    if (!use.used()) continue;
    const Texture& texture = mesh.textures[as_size(use.texture)];
    all.back().texture = std::make_shared<const Texture>(Texture{texture.name, texture.image()});
  }
  return all;
}

std::string counted(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string described(const PyScene& self) {
  const Scene& s = self.scene;
  return "<Scene" +
         (s.source.empty() ? "" : " " + shown(std::filesystem::path(s.source).filename().string())) + ": " +
         counted(s.mesh->triangles.size(), "triangle") + ", " +
         counted(s.mesh->materials.size(), "material") + ", " +
         counted(s.nodes ? s.nodes->nodes.size() : 0, "node") + ", " + counted(self.lights.size(), "light") +
         ", " + counted(self.cameras.size(), "camera") + ">";
}

const Mesh& mesh_of(nb::handle self) {
  return *nb::cast<const PyScene&>(self).scene.mesh;
}

using SceneClass = nb::class_<PyScene>;
using MaterialList = std::variant<TexturedMaterial, std::vector<TexturedMaterial>>;

void bind_making(SceneClass& bound) {
  bound
      .def(
          "__init__",
          [](PyScene* self, const Floats3& vertices, const Words3& triangles,
             const std::optional<Floats3>& normals, const std::optional<Floats2>& uvs,
             const std::optional<Floats3>& colors, const std::optional<MaterialList>& materials,
             const std::optional<Words>& triangle_materials, const nb::typed<nb::iterable, Light>& lights,
             const Three& ambient, nb::object environment) {
            std::vector<TexturedMaterial> all;
            if (materials && std::holds_alternative<TexturedMaterial>(*materials))
              all.push_back(std::get<TexturedMaterial>(*materials));
            else if (materials)
              all = std::get<std::vector<TexturedMaterial>>(*materials);
            Scene scene =
                scene_of(vertices, triangles, normals, uvs, colors, all, triangle_materials, ambient);
            scene.lights = all_of<Light>(lights, "lights", "Light");
            PyScene made(std::move(scene));
            set_environment(made, environment);
            new (self) PyScene(std::move(made));
          },
          "vertices"_a, "triangles"_a, "normals"_a = nb::none(), "uvs"_a = nb::none(),
          "colors"_a = nb::none(), "materials"_a = nb::none(), "triangle_materials"_a = nb::none(),
          "lights"_a = nb::make_tuple(), "ambient"_a = glm::vec3(0.1f), "environment"_a = nb::none(),
          "vertices: (n, 3) float32, in any unit. triangles: (m, 3) uint32, indices of vertices.\n"
          "normals: (n, 3) float32. None: triangles are flat.\n"
          "uvs: (n, 2) float32. (0, 0) is the texture's first texel.\n"
          "colors: (n, 3) of the vertices or (m, 3) of the triangles, linear, 1 is white. They multiply the "
          "materials' diffuse and\n"
          "ambient; without materials these are 1. If n equals m, they are the vertices'.\n"
          "materials: a Material or a list of them. triangle_materials: (m,) uint32, the index of each "
          "triangle's material.\n"
          "environment: the light around the scene, as the property of that name.\n"
          "A scene without lights is drawn with one above the camera.\n"
          "Raises Error if the numbers of rows do not match, an index is out of range, a number is not "
          "finite or a colour is\n"
          "negative.")
      .def("__repr__", &described)
      .def("__copy__", [](const PyScene& self) { return PyScene(self.now()); })
      .def(
          "__deepcopy__", [](const PyScene& self, nb::handle) { return PyScene(self.now()); }, "memo"_a,
          "A copy with lights and cameras of its own. The mesh, which never changes, is shared.")
      .def("__getstate__", [](const PyScene& self) { return pickled(self.now()); })
      .def("__setstate__", [](PyScene& self, const nb::bytes& state) {
        Scene scene;
        unpickle(state, scene);
        new (&self) PyScene(std::move(scene));
      });
}

void bind_surroundings(SceneClass& bound) {
  bound
      .def_prop_rw(
          "lights", [](const PyScene& s) { return nb::typed<nb::list, Light>(s.lights); },
          [](PyScene& s, const nb::typed<nb::iterable, Light>& lights) {
            const nb::list all(lights);  // a generator is read once
            (void)all_of<Light>(all, "lights", "Light");
            s.lights = all;
          },
          "A list of Light: append to it, or change its lights, and the next picture shows it.")
      .def_prop_rw(
          "cameras", [](const PyScene& s) { return nb::typed<nb::list, Camera>(s.cameras); },
          [](PyScene& s, const nb::typed<nb::iterable, Camera>& cameras) {
            const nb::list all(cameras);
            (void)all_of<Camera>(all, "cameras", "Camera");
            s.cameras = all;
          },
          "A list of Camera, which can be changed as lights can.")
      .def_prop_rw(
          "environment", &environment_of, &set_environment, nb::for_setter(nb::arg("value").none()),
          nb::for_getter(nb::sig("def environment(self) -> numpy.typing.NDArray[numpy.float32] | None")),
          nb::for_setter(nb::sig("def environment(self, value: str | os.PathLike[str] | "
                                 "numpy.typing.ArrayLike | None, /) -> None")),
          "The light from all directions around the scene, (height, width, 3) float32, linear: a picture in "
          "latitude\n"
          "and longitude, whose top row is +Y, whose middle is +Z, and +X a quarter of the width to the left "
          "of it.\n"
          "None: there is none. Set it to such an array, or to the path of an EXR or HDR file. The settings\n"
          "environment_strength and environment_rotation of a picture change it.\n"
          "Raises Error if the file cannot be read, or if light is negative or not finite.")
      .def_prop_ro(
          "source", [](const PyScene& s) { return text(s.scene.source); },
          "The path of the file that the scene was loaded from.")
      .def_prop_ro(
          "variants", [](const PyScene& s) { return s.scene.variants; },
          "The names of the file's variants of its materials: load_scene(path, variant=name).");
  def_three(
      bound, "ambient", [](PyScene& s) -> glm::vec3& { return s.scene.ambient_light; },
      "Light that reaches every point, linear.");
}

void bind_mesh(SceneClass& bound) {
  bound
      .def_prop_ro(
          "bounds",
          [](const PyScene& s) {
            const Bounds& box = s.scene.mesh->bounds();
            return std::array{box.lo, box.hi};
          },
          "The lowest and the highest corner of the scene's box.")
      .def_prop_ro(
          "vertices",
          [](nb::handle self) {
            const Mesh& mesh = mesh_of(self);
            return view_of<const float>(&mesh.positions.data()->x, {mesh.positions.size(), 3}, self);
          },
          "(n, 3) float32, in world space. The array is not a copy.")
      .def_prop_ro(
          "normals",
          [](nb::handle self) {
            const Mesh& mesh = mesh_of(self);
            return view_of<const float>(&mesh.normals.data()->x, {mesh.normals.size(), 3}, self);
          },
          "(n, 3) float32; 0 where the triangle's own normal is used. The array is not a copy.")
      .def_prop_ro(
          "uvs",
          [](nb::handle self) -> std::optional<nb::ndarray<nb::numpy, const float>> {
            const Mesh& mesh = mesh_of(self);
            if (mesh.texcoords.empty()) return std::nullopt;
            return view_of<const float>(&mesh.texcoords.data()->x, {mesh.texcoords.size(), 2}, self);
          },
          "(n, 2) float32; v grows downwards. None: the scene has none. The array is not a copy.")
      .def_prop_ro(
          "colors",
          [](nb::handle self) -> std::optional<nb::ndarray<nb::numpy, const float>> {
            const Mesh& mesh = mesh_of(self);
            if (mesh.colors.empty()) return std::nullopt;
            return view_of<const float>(&mesh.colors.data()->x, {mesh.colors.size(), 4}, self);
          },
          "(n, 4) float32: the vertices' linear RGBA. None: the scene has none. The array is not a copy.")
      .def_prop_ro(
          "triangles",
          [](nb::handle self) {
            const Mesh& mesh = mesh_of(self);
            return view_of<const std::uint32_t>(&mesh.triangles.data()->x, {mesh.triangles.size(), 3}, self);
          },
          "(m, 3) uint32. The index of a row is the triangle's id. The array is not a copy.")
      .def_prop_ro(
          "triangle_materials",
          [](nb::handle self) {
            const Mesh& mesh = mesh_of(self);
            return view_of<const std::uint32_t>(mesh.triangle_materials.data(),
                                                {mesh.triangle_materials.size()}, self);
          },
          "(m,) uint32: the index in `materials` of each triangle's material. The array is not a copy.")
      .def_prop_ro(
          "materials", [](const PyScene& s) { return materials_of(*s.scene.mesh); },
          "The materials, in the order of `triangle_materials`. A Material has the base colour's texture; "
          "other "
          "textures\n"
          "are in the scene alone.");
}

}  // namespace

PyScene::PyScene(Scene from) : scene(std::move(from)) {
  for (Light& light : scene.lights) lights.append(std::move(light));
  for (Camera& camera : scene.cameras) cameras.append(std::move(camera));
  scene.lights.clear();
  scene.cameras.clear();
}

Scene PyScene::now() const {
  Scene copy = scene;
  copy.lights = all_of<Light>(lights, "scene.lights", "Light");
  copy.cameras = all_of<Camera>(cameras, "scene.cameras", "Camera");
  return copy;
}

void bind_scene(nb::module_& module) {
  SceneClass bound(module, "Scene", "A mesh, which copies share, with lights, cameras and an environment.");
  bind_making(bound);
  bind_surroundings(bound);
  bind_mesh(bound);
  bind_nodes(bound);
  module.def(
      "load_scene", &load, "path"_a, "confine"_a = false, "shading"_a = "auto", "animation"_a = "",
      "up_axis"_a = "y", "point_size"_a = 0.0, "line_width"_a = 0.0, "variant"_a = "",
      "load_limit"_a = kUsualLoadLimit >> 20,
      nb::sig(
          "def load_scene(path: str | os.PathLike[str], confine: bool = False, shading: str = 'auto', "
          "animation: int | str = '', up_axis: str = 'y', point_size: float = 0.0, line_width: float = 0.0, "
          "variant: str = '', load_limit: int = 4096) -> Scene"),
      "Reads a scene by its extension: .gltf, .glb, .obj, .ply or .stl. What is left out of the file is a "
      "warning. With\n"
      "confine, files that it names are opened only below its folder, wherever names and links lead.\n"
      "shading: 'auto', the file's reflection model (glTF's for metallic-roughness materials, else Phong's), "
      "or 'phong'.\n"
      "animation: the name or the number of the file's animation that plays. '': all, together.\n"
      "up_axis: 'z' turns a file whose z points up, as many STL files do.\n"
      "point_size, line_width: diameters, in scene units, of the balls and tubes that draw the file's points "
      "and lines. 0: they are left out.\n"
      "variant: the name of one of the file's variants of its materials (Scene.variants). '': those that it "
      "shows first.\n"
      "load_limit: the MiB of memory that the file may ask for beyond its own size (4096).\n"
      "Raises Error if the file cannot be read, is damaged, needs more memory than that or, with confine, "
      "names a file outside\n"
      "its folder, if an argument has an unknown value, or if there is no such animation or variant.");
  module.def(
      "assemble", &assemble, "parts"_a,
      nb::sig("def assemble(parts: collections.abc.Mapping[str, Scene] | collections.abc.Mapping[str, "
              "tuple[Scene, numpy.typing.ArrayLike]] | collections.abc.Mapping[str, Scene | tuple[Scene, "
              "numpy.typing.ArrayLike]]) -> Scene"),
      "One scene of several: {name: scene} or {name: (scene, 4x4 matrix)}. Each becomes a node that "
      "can be moved\n"
      "(Scene.posed), with its own nodes below it. Raises Error if a part is neither, or if there are no "
      "triangles.");
}

}  // namespace pinocchio::python
