#include "python/src/result.h"

#include <nanobind/stl/filesystem.h>

#include "python/src/interrupt.h"
#include "python/src/parts.h"

namespace pinocchio::python {
namespace {

template <class T>
auto picture(Image<T>& image, nb::handle owner) {
  return view_of<T>(image.pixels().data(),
                    {static_cast<std::size_t>(image.height()), static_cast<std::size_t>(image.width())},
                    owner);
}

template <int N>
auto picture(Image<glm::vec<N, float, glm::defaultp>>& image, nb::handle owner) {
  return view_of<float>(
      &image.pixels().data()->x,
      {static_cast<std::size_t>(image.height()), static_cast<std::size_t>(image.width()), std::size_t{N}},
      owner);
}

// Several threads may make them at the same time; the first one's are kept, as arrays view them.
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
  rays["primary"] = r.rays.primary;
  rays["shadow"] = r.rays.shadow;
  rays["reflection"] = r.rays.reflection;
  rays["refraction"] = r.rays.refraction;
  rays["indirect"] = r.rays.indirect;
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

auto mask(nb::handle self) {
  Result& result = nb::cast<Result&>(self);
  if (result.mask.empty()) {
    result.mask = Image<std::uint8_t>(result.frame.ids.size());
    unpack_mask(result.frame, result.mask.pixels().data());
  }
  return picture(result.mask, self);
}

auto objects(nb::handle self) {
  Result& result = nb::cast<Result&>(self);
  if (result.objects.empty()) {
    result.objects = Image<std::uint32_t>(result.frame.ids.size());
    for (std::size_t i = 0; i < result.frame.ids.pixels().size(); ++i)
      result.objects[i] = object_of(result.frame.scene, result.frame.ids[i]);
  }
  return picture(result.objects, self);
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
  nb::class_<Result>(
      module, "Result",
      "A finished picture. Arrays are (height, width, ...), row 0 on top; they are views, made when\n"
      "first asked for.")
      .def_prop_ro(
          "color", &of_frame<&FrameResult::color>,
          "(h, w, 4) float32: linear RGBA, mean of the samples. A: how much of the pixel is covered.")
      .def_prop_ro("depth", &of_surfaces<&SurfaceImages::z_eye>,
                   "(h, w) float32: distance along the view axis, scene units; inf where nothing is hit.")
      .def_prop_ro("position", &of_surfaces<&SurfaceImages::p_world>,
                   "(h, w, 3) float32, world; 0 where nothing is hit.")
      .def_prop_ro("normal", &of_surfaces<&SurfaceImages::n_shading>,
                   "(h, w, 3) float32: world shading normal, unit; 0 where nothing is hit.")
      .def_prop_ro("albedo", &of_surfaces<&SurfaceImages::albedo>,
                   "(h, w, 3) float32: diffuse colour, linear.")
      .def_prop_ro("ids", &of_frame<&FrameResult::ids>,
                   "(h, w) uint32: the triangle; 0xffffffff where nothing is hit.")
      .def_prop_ro("objects", &objects,
                   "(h, w) uint32: the node (Scene.nodes) that the triangle moves with; 0xffffffff where "
                   "nothing is hit.")
      .def_prop_ro("mask", &mask,
                   "(h, w) uint8: bit i is set where the light in mask slot i reaches the point.")
      .def_prop_ro("reflection", &reflection, "(h, w, 3) float32: mirrored and refracted light, linear.")
      .def_prop_ro("record", &record, "What it cost: 'ms', 'stages' (ms), 'bytes', 'rays'.")
      .def_prop_ro("camera", [](const Result& r) { return r.frame.view.camera; })
      .def(
          "write_exr",
          [](const Result& r, const std::filesystem::path& path, const std::string& aov, bool deterministic) {
            ExrOptions options{.layers = aov};
            if (!deterministic) options.render_s = 1e-3 * r.ms;
            without_gil(
                [&](Progress* progress) { return write_exr(path, r.frame, options, progress), true; });
          },
          "path"_a, "aov"_a = "all", "deterministic"_a = false,
          "The picture with its layers, as the program writes it. aov: 'all', 'none' or some of Z, P, N, "
          "Albedo, id,\n"
          "shadow, reflection, with commas between. deterministic: leaves out how long it took.");
}

}  // namespace pinocchio::python
