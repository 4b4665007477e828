#include "core/output/frame_exr.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ranges>
#include <span>
#include <type_traits>

#include "core/base/system_info.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"
#include "pinocchio/names.h"
#include "pinocchio/nodes.h"

namespace pinocchio {
namespace {

// One channel a component of the values.
template <class Pixel>
void add_channels(const LayerRow& row, std::span<const Pixel> pixels, std::vector<ExrChannel>& channels) {
  for (int c = 0; const std::string_view name : row.exr.channels) {
    if (name.empty()) break;
    ExrChannel& channel = channels.emplace_back(std::string(name), row.exr.type);
    if constexpr (std::is_integral_v<Pixel>) {
      channel.uints.assign(pixels.begin(), pixels.end());
    } else if constexpr (std::is_same_v<Pixel, float>) {
      channel.values.assign(pixels.begin(), pixels.end());
    } else {
      const auto values =
          std::views::transform(pixels, [c](const Pixel& pixel) -> const float& { return pixel[c]; });
      channel.values.assign(values.begin(), values.end());
    }
    ++c;
  }
}

// Casting lights of a mask's channel: shadow.mask, shadow.mask1 and so on.
constexpr std::size_t kLightsOfChannel = 32;

// The bytes of a pixel's mask.
std::size_t mask_bytes_of(const Scene& scene) {
  const std::size_t lights = casting_lights(scene).size();
  return lights <= 8 ? 1 : (lights + kLightsOfChannel - 1) / kLightsOfChannel * sizeof(std::uint32_t);
}

void add_mask_channels(const LayerRow& row, const FrameArrays& of, std::size_t pixels,
                       std::vector<ExrChannel>& channels) {
  for (std::size_t first = 0; first < of.mask_bytes; first += sizeof(std::uint32_t)) {
    const std::size_t number = first / sizeof(std::uint32_t);
    ExrChannel& channel = channels.emplace_back(
        std::string(row.exr.channels.front()) + (number == 0 ? "" : std::to_string(number)), row.exr.type);
    channel.uints.resize(pixels);
    const std::size_t bytes = std::min(of.mask_bytes - first, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t byte = 0; byte < bytes; ++byte)
        channel.uints[i] |= std::uint32_t{of.mask[i * of.mask_bytes + first + byte]} << 8 * byte;
  }
}

nlohmann::json vec3_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

// Rows of a matrix for column vectors.
glm::mat4 from_rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
  return glm::mat4(glm::transpose(glm::dmat4(x, y, z, w)));
}

// The row that gives (p_world - eye) . axis
glm::dvec4 along(const glm::vec3& axis, const glm::vec3& eye) {
  return {glm::dvec3(axis), -glm::dot(glm::dvec3(axis), glm::dvec3(eye))};
}

// The names, by number; bytes that are not UTF-8 are replaced.
template <class Named>
std::string names_json(const std::vector<Named>& all) {
  nlohmann::json names = nlohmann::json::array();
  for (const Named& one : all) names.push_back(one.name);
  return names.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// What the numbers in the layers mean.
void add_names(ExrFile& exr, const FrameOutput& frame, const AovSet& aovs) {
  const auto wanted = [&](Layer layer) { return aovs.contains(std::string(layer_row(layer).exr.name)); };
  if (wanted(Layer::objects))
    exr.attributes["pinocchio.nodes"] =
        frame.scene.nodes ? names_json(frame.scene.nodes->nodes) : std::string("[]");
  if (wanted(Layer::materials))
    exr.attributes["pinocchio.materials"] = names_json(frame.scene.mesh->materials);
}

// The camera, where it is no pinhole.
void add_projection(ExrFile& exr, const FrameOutput& frame) {
  const Camera& camera = frame.camera;
  if (frame.has_rays) {
    exr.attributes["pinocchio.projection"] = std::string("rays");
    return;
  }
  if (camera.projection != Projection::perspective)
    exr.attributes["pinocchio.projection"] = std::string(name_of(kProjectionNames, camera.projection));
  if (camera.projection == Projection::fisheye || camera.is_distorted()) {
    const Intrinsics k = intrinsics_of(camera, frame.size);
    exr.attributes["pinocchio.intrinsics"] = nlohmann::json{
        {"fx", k.fx},
        {"fy", k.fy},
        {"cx", k.cx},
        {"cy", k.cy},
        {"distortion", camera.distortion}}.dump();
  }
}

void add_attributes(ExrFile& exr, const FrameOutput& frame) {
  exr.attributes["worldToCamera"] = world_to_camera(frame.camera);
  if (frame.camera.is_rasterisable() && !frame.has_rays)
    exr.attributes["worldToNDC"] = world_to_ndc(frame.camera, frame.size);
  add_projection(exr, frame);
  exr.attributes["pinocchio.version"] = std::string(version());
  exr.attributes["pinocchio.plan"] = frame.plan_json;
  exr.attributes["pinocchio.scene"] = std::filesystem::path(frame.scene.source).filename().string();
  if (frame.scene.environment)
    exr.attributes["pinocchio.environment"] =
        std::filesystem::path(frame.scene.environment->source()).filename().string();
  exr.attributes["pinocchio.frame"] = frame.frame;
  exr.attributes["pinocchio.time"] =
      as_float(frame.time_s.value_or(frame.frame / as_double(frame.frames_per_second)));
  if (!frame.inputs.empty()) exr.attributes["pinocchio.inputs"] = frame.inputs;
  exr.attributes["pinocchio.camera"] = frame.camera.name;
  if (frame.camera.lens_radius > 0.0f) {
    exr.attributes["pinocchio.lensRadius"] = frame.camera.lens_radius;
    exr.attributes["pinocchio.focusDistance"] = focus_distance(frame.camera);
  }
  exr.attributes["pinocchio.lights"] = lights_json(frame.scene);
  exr.attributes["pinocchio.unshadowedLights"] = unshadowed_lights_json(frame.scene);
  exr.attributes["samplesPerPixel"] = frame.samples_per_pixel;
  exr.attributes["framesPerSecond"] = ExrRational{frame.frames_per_second, 1};
  if (frame.age_frames > 0)
    exr.attributes["pinocchio.reprojected"] = "shows shadows and reflections of " +
                                              std::to_string(frame.age_frames) +
                                              " frame(s) before, warped; shadow.mask and reflection are left "
                                              "out, as this frame's own were not traced yet";
  if (frame.render_s) exr.attributes["renderTimeSeconds"] = as_float(*frame.render_s);
  exr.reproducible = !frame.render_s;
}

}  // namespace

std::vector<ExrChannel> frame_channels(const FrameOutput& frame, const AovSet& aovs, int y0, int y1) {
  const auto count = frame.part.size().x * as_size(y1 - y0);
  FrameArrays to;
  to.mask_bytes = mask_bytes_of(frame.scene);
  std::array<std::vector<std::byte>, kLayers.size()> memory;
  // Calls use(row, member, memory) for each layer of the file; `member`: of FrameArrays.
  const auto for_each_layer = [&](const auto& use) {
    for (std::size_t i = 0; i < kLayers.size(); ++i) {
      const LayerRow& row = kLayers[i];
      if (row.exr.channels.front().empty() ||
          (!row.exr.name.empty() && !aovs.contains(std::string(row.exr.name))))
        continue;
      std::visit(
          [&](auto member) {
            if constexpr (!std::is_same_v<decltype(member), std::monostate>) use(row, member, memory[i]);
          },
          row.array.values);
    }
  };
  for_each_layer([&](const LayerRow& row, auto member, std::vector<std::byte>& bytes) {
    using Pointer = std::remove_reference_t<decltype(to.*member)>;
    bytes.resize(count * sizeof(*(to.*member)) * (row.layer == Layer::mask ? to.mask_bytes : 1));
    to.*member = reinterpret_cast<Pointer>(bytes.data());
  });
  if (count > 0) frame.write_lines(y0, y1, to);
  std::vector<ExrChannel> channels;
  for_each_layer([&](const LayerRow& row, auto member, const std::vector<std::byte>&) {
    using Pixel = std::remove_pointer_t<std::remove_reference_t<decltype(to.*member)>>;
    if (row.layer == Layer::mask)
      add_mask_channels(row, to, count, channels);
    else
      add_channels<Pixel>(row, {to.*member, count}, channels);
  });
  return channels;
}

ExrFile frame_exr(const FrameOutput& frame, const AovSet& aovs, int y0, int y1) {
  ExrFile exr;
  exr.display_size = frame.size;
  exr.data_window = frame.part;
  add_attributes(exr, frame);
  add_names(exr, frame, aovs);
  exr.channels = frame_channels(frame, aovs, y0, y1);
  return exr;
}

glm::mat4 world_to_camera(const Camera& camera) {
  const CameraAxes axes = camera_axes(camera);
  return from_rows(along(axes.right, camera.eye), along(axes.up, camera.eye), along(axes.forward, camera.eye),
                   {0, 0, 0, 1});
}

glm::mat4 world_to_ndc(const Camera& camera, glm::ivec2 size) {
  const CameraAxes axes = camera_axes(camera);
  const bool parallel = camera.projection == Projection::orthographic;
  const double height =
      parallel ? as_double(camera.height) : 2.0 * std::tan(glm::radians(as_double(camera.fov_deg)) * 0.5);
  const double aspect = as_double(size.x) / size.y;
  const double width = height * aspect * camera.pixel_aspect;
  const glm::dvec2 axis = 0.5 + glm::dvec2(camera.axis_shift) / glm::dvec2(aspect, 1.0);
  if (parallel)
    return from_rows(along(axes.right, camera.eye) / width + glm::dvec4(0, 0, 0, axis.x),
                     glm::dvec4(0, 0, 0, axis.y) - along(axes.up, camera.eye) / height,
                     along(axes.forward, camera.eye), {0, 0, 0, 1});
  const glm::dvec4 z = along(axes.forward, camera.eye);
  return from_rows(along(axes.right, camera.eye) / width + axis.x * z,
                   axis.y * z - along(axes.up, camera.eye) / height, {0, 0, 0, 1}, z);
}

namespace {

nlohmann::json light_json(const Light& light) {
  const LightKind& kind = kind_of(light);
  nlohmann::json json{{"name", light.name},
                      {"kind", kind.name},
                      {"color", vec3_json(light.color)},
                      {"intensity", light.intensity}};
  if (kind.has_position) json["position"] = vec3_json(light.position);
  if (kind.has_direction) json["direction"] = vec3_json(light.direction);
  if (kind.has_cone) json["cone"] = {{"cosInner", light.cos_inner}, {"cosOuter", light.cos_outer}};
  if (light.falloff == Light::Falloff::inverse_square) json["falloff"] = "inverse square";
  if (std::isfinite(light.range)) json["range"] = light.range;
  for (const LightSize& size : kLightSizes)
    if (light.*size.value > 0.0f) json[std::string(size.exr_name)] = light.*size.value;
  if (kind.has_sides) json["edges"] = {vec3_json(light.edge_u), vec3_json(light.edge_v)};
  return json;
}

std::string all_lights_json(const Scene& scene, bool casting) {
  nlohmann::json lights = nlohmann::json::array();
  for (const Light& light : scene.lights)
    if (light.casts_shadow == casting) lights.push_back(light_json(light));
  // Names of files may be no UTF-8.
  return lights.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string lights_json(const Scene& scene) {
  return all_lights_json(scene, true);
}

std::string unshadowed_lights_json(const Scene& scene) {
  return all_lights_json(scene, false);
}

}  // namespace pinocchio
