#include "python/src/result.h"

#include <pinocchio/layers.h>
#include <pinocchio/names.h>

#include <nanobind/stl/filesystem.h>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>

#include "pinocchio/conversion.h"
#include "python/src/layers.h"
#include "python/src/scene/scene.h"
#include "python/src/support/interrupt.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

template <class T>
auto picture(Image<T>& image, nb::handle owner) {
  return view_of<T>(image.pixels().data(), {as_size(image.height()), as_size(image.width())}, owner);
}

template <int N>
auto picture(Image<glm::vec<N, float, glm::defaultp>>& image, nb::handle owner) {
  return view_of<float>(&image.pixels().data()->x,
                        {as_size(image.height()), as_size(image.width()), std::size_t{N}}, owner);
}

// Several threads may compute them at the same time. The first result is kept, because arrays are views of
// it.
SurfaceImages& surfaces(Result& result) {
  if (!result.surfaces) {
    SurfaceImages made = without_gil([&](Progress*) { return surfaces_of(result.frame); });
    if (!result.surfaces) result.surfaces = std::move(made);
  }
  return *result.surfaces;
}

nb::dict record(const Result& result) {
  const FrameRecord& r = result.frame.record;
  nb::dict stages, buffers, bytes, rays, all;
  for (std::size_t i = 0; i < kStageNames.size(); ++i)
    if (r.stages[i].begin_s > 0.0 && r.stages[i].ms() > 0.0)
      stages[nb::str(kStageNames[i].data(), kStageNames[i].size())] = r.stages[i].ms();
  for (std::size_t i = 0; i < kChannelNames.size(); ++i)
    if (r.bytes[i] > 0) buffers[nb::str(kChannelNames[i].data(), kChannelNames[i].size())] = r.bytes[i];
  bytes["gpu_to_cpu"] = r.bytes_to_cpu();
  bytes["cpu_to_gpu"] = r.bytes_to_gpu();
  bytes["buffers"] = buffers;
  for (const RayKind& kind : kRayKinds)
    rays[nb::str(kind.name.data(), kind.name.size())] = r.rays.*kind.count;
  all["ms"] = result.ms;
  all["stages"] = stages;
  all["bytes"] = bytes;
  all["rays"] = rays;
  return all;
}

auto reflection(nb::handle self) {
  Result& result = nb::cast<Result&>(self);
  if (!result.frame.reflection.empty()) return picture(result.frame.reflection, self);
  if (result.no_reflection.empty())
    result.no_reflection = Image<glm::vec3>(result.frame.ids.size(), glm::vec3(0.0f));
  return picture(result.no_reflection, self);
}

nb::ndarray<nb::numpy> mask(nb::handle self) {
  Result& result = nb::cast<Result&>(self);
  const Image<std::uint32_t>& ids = result.frame.ids;
  const std::size_t bytes = MaskImage::bytes_for(casting_lights(result.frame.scene).size());
  if (result.mask.empty()) {
    result.mask.resize((ids.pixels().size() * bytes + 7) / 8);
    unpack_mask(result.frame, reinterpret_cast<std::uint8_t*>(result.mask.data()), bytes);
  }
  const PixelType type = mask_type(bytes);
  std::vector<std::size_t> shape{as_size(ids.height()), as_size(ids.width())};
  if (type.numbers > 1) shape.push_back(type.numbers);
  return {result.mask.data(), shape.size(), shape.data(), self, nullptr, type.type};
}

// A layer of numbers that are looked up by the ids.
template <auto Member, auto Array>
auto identities(nb::handle self) {
  Result& result = nb::cast<Result&>(self);
  Image<std::uint32_t>& image = result.*Member;
  if (image.empty()) {
    Image<std::uint32_t> made(result.frame.ids.size());
    FrameArrays to;
    to.*Array = made.pixels().data();
    without_gil([&](Progress*) { return write_layers(result.frame, to), true; });
    if (image.empty()) image = std::move(made);
  }
  return picture(image, self);
}

// The other frame that motion leads to: the scene and the camera that are given, else this picture's own.
MotionTo motion_to(const Result& result, const PyScene* scene, const Camera* camera) {
  const Mesh& mesh = *result.frame.scene.mesh;
  if (scene && scene->scene.mesh->triangles.size() != mesh.triangles.size())
    throw Error("the other scene has " + std::to_string(scene->scene.mesh->triangles.size()) +
                " triangles, this one " + std::to_string(mesh.triangles.size()) +
                "; motion is between two poses of one scene (Scene.posed, Scene.at_time)");
  return {scene ? scene->scene.mesh : nullptr, camera ? *camera : result.frame.view.camera};
}

auto motion(const Result& result, const PyScene* scene, const Camera* camera) {
  FrameResult frame = result.frame;
  frame.motion = motion_to(result, scene, camera);
  std::vector<glm::vec2> values(frame.ids.pixels().size());
  FrameArrays to;
  to.motion = values.data();
  without_gil([&](Progress*) { return write_layers(frame, to), true; });
  const auto height = as_size(frame.ids.height()), width = as_size(frame.ids.width());
  return array_that_owns<float>(std::move(values), {height, width, 2});
}

// Read-only: depth, position, normal, albedo and objects index the scene by them.
auto ids(nb::handle self) {
  const Image<std::uint32_t>& ids = nb::cast<Result&>(self).frame.ids;
  return view_of<const std::uint32_t>(ids.pixels().data(), {as_size(ids.height()), as_size(ids.width())},
                                      self);
}

bool has_extension(const std::filesystem::path& path, const char* wanted) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == wanted;
}

ToneMap curve_named(const std::string& name) {
  const auto curve = parse_name<ToneMap>(kToneMapNames, name);
  if (!curve) throw Error("tone_map is '" + name + "'; it is 'clip', 'reinhard', 'aces' or 'neutral'");
  return *curve;
}

std::string milliseconds(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", ms);
  return text;
}

template <auto M>
auto of_frame(nb::handle self) {
  return picture(nb::cast<Result&>(self).frame.*M, self);
}
template <auto M>
auto of_surfaces(nb::handle self) {
  return picture(surfaces(nb::cast<Result&>(self)).*M, self);
}

}  // namespace

void bind_result(nb::module_& module) {
  static std::map<Layer, std::string> docs;
  const auto doc = [](Layer layer) { return docs.emplace(layer, doc_of(layer)).first->second.c_str(); };
  static const std::string ids_doc = doc_of(Layer::ids) + " Read-only.";
  nb::class_<Result> bound(
      module, "Result",
      "A finished picture. Arrays are (height, width, ...) with row 0 on top. They are views, "
      "which are made\n"
      "at first use.");
  bound.def_prop_ro("color", &of_frame<&FrameResult::color>, doc(Layer::picture))
      .def_prop_ro("depth", &of_surfaces<&SurfaceImages::z_eye>, doc(Layer::depth))
      .def_prop_ro("position", &of_surfaces<&SurfaceImages::p_world>, doc(Layer::position))
      .def_prop_ro("normal", &of_surfaces<&SurfaceImages::n_shading>, doc(Layer::normals))
      .def_prop_ro("albedo", &of_surfaces<&SurfaceImages::albedo>, doc(Layer::albedo))
      .def_prop_ro("ids", &ids, ids_doc.c_str())
      .def_prop_ro("objects", &identities<&Result::objects, &FrameArrays::objects>, doc(Layer::objects))
      .def_prop_ro("materials", &identities<&Result::materials, &FrameArrays::materials>,
                   doc(Layer::materials))
      .def_prop_ro("primitives", &identities<&Result::primitives, &FrameArrays::primitives>,
                   doc(Layer::primitives))
      .def("motion", &motion, "scene"_a.none() = nb::none(), "camera"_a.none() = nb::none(),
           nb::rv_policy::reference,
           "(h, w, 2) float32: pixels from each point to its place in another frame, x to the right and y "
           "down; 0 where\n"
           "nothing is hit, NaN where the other frame's camera does not see the point.\n"
           "scene: the scene in its other pose (Scene.posed, Scene.at_time). None: nothing has moved.\n"
           "camera: the other frame's. None: this picture's.\n"
           "Raises Error if the other scene has other triangles.")
      .def_prop_ro("mask", &mask, doc(Layer::mask),
                   nb::for_getter(nb::sig("def mask(self) -> numpy.typing.NDArray[typing.Any]")))
      .def_prop_ro("reflection", &reflection, doc(Layer::reflection))
      .def_prop_ro("record", &record, nb::sig("def record(self) -> dict[str, typing.Any]"),
                   "The cost as a dict: 'ms', 'stages' (ms), 'bytes', 'rays'.")
      .def_prop_ro("camera", [](const Result& r) { return r.frame.view.camera; })
      .def(
          "write_exr",
          [](const Result& r, const std::filesystem::path& path, const std::string& aov, bool deterministic,
             const PyScene* motion_scene, const Camera* motion_camera) {
            if (!has_extension(path, ".exr"))
              throw Error(path.string() + ": write_exr writes EXR files; end the name in .exr" +
                          (has_extension(path, ".png") ? ", or use write_png" : ""));
            ExrOptions options{.layers = aov};
            if (!deterministic) options.render_s = 1e-3 * r.ms;
            FrameResult frame = r.frame;
            frame.motion = motion_to(r, motion_scene, motion_camera);
            without_gil([&](Progress* progress) { return write_exr(path, frame, options, progress), true; });
          },
          "path"_a, "aov"_a = "all", "deterministic"_a = false, "motion_scene"_a.none() = nb::none(),
          "motion_camera"_a.none() = nb::none(),
          nb::sig("def write_exr(self, path: str | os.PathLike[str], aov: str = 'all', deterministic: bool = "
                  "False, motion_scene: Scene | None = None, motion_camera: Camera | None = None) -> None"),
          "Writes the picture with its layers to an EXR file, as the program does.\n"
          "path: the file, which is written whole or not at all.\n"
          "aov: 'all', 'none' or some of the program's --aov, separated by commas.\n"
          "deterministic: without the render time, so that the same picture has the same bytes on every "
          "machine; "
          "packing then takes longer.\n"
          "motion_scene, motion_camera: of the layer motion, as for Result.motion.\n"
          "Raises Error if the file cannot be written, if its name does not end in .exr or if there is no "
          "such "
          "layer.")
      .def(
          "write_png",
          [](const Result& r, const std::filesystem::path& path, double exposure,
             const std::string& tone_map) {
            if (!has_extension(path, ".png"))
              throw Error(path.string() + ": write_png writes PNG files; end the name in .png");
            const PngOptions options{number_within(exposure, "exposure", -64.0, 64.0), curve_named(tone_map)};
            without_gil([&](Progress*) { return write_png(path, r.frame, options), true; });
          },
          "path"_a, "exposure"_a = 0.0f, "tone_map"_a = "clip",
          nb::sig("def write_png(self, path: str | os.PathLike[str], exposure: float = 0.0, tone_map: str = "
                  "'clip') -> None"),
          "Writes the colour as a screen shows it: sRGB, 8 bits, with alpha where neither an environment nor "
          "a "
          "colour is behind the scene.\n"
          "path: the file, which is written whole or not at all. exposure: stops brighter, from -64 to 64.\n"
          "tone_map: the curve of bright light: 'clip' (what is brighter than white is white), 'reinhard', "
          "'aces' or 'neutral'.\n"
          "Raises Error if the file cannot be written, if its name does not end in .png or if there is no "
          "such curve.")
      .def("_repr_png_",
           [](const Result& r) {
             const std::string png = without_gil([&](Progress*) { return encode_png(r.frame); });
             return nb::bytes(png.data(), png.size());
           })
      .def("__repr__", [](const Result& r) {
        return "<Result: " + std::to_string(r.frame.color.width()) + "x" +
               std::to_string(r.frame.color.height()) + " pixels, " +
               std::to_string(r.frame.settings.spp.value) + " spp, " + milliseconds(r.ms) + " ms>";
      });
  def_no_pickle(
      bound,
      "a Result does not pickle: send its arrays (result.color, result.depth and so on), or write_exr");
}

}  // namespace pinocchio::python
