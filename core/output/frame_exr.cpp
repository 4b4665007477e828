#include "core/output/frame_exr.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/system_info.h"
#include "core/trace/view_params.h"

namespace pinocchio {
namespace {

using Type = ExrChannel::Type;

// One channel a component: names[c] gets component c of every pixel.
template <class Pixel>
void add_vector(ExrFile& exr, const Image<Pixel>& image, Type type, const std::vector<std::string>& names) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    ExrChannel channel{names[c], type, {}, {}};
    channel.values.reserve(image.pixels().size());
    for (const Pixel& pixel : image.pixels()) channel.values.push_back(pixel[static_cast<int>(c)]);
    exr.channels.push_back(std::move(channel));
  }
}

ExrChannel mask_channel(const MaskImage& mask, glm::ivec2 size) {
  ExrChannel channel{"shadow.mask", Type::uint, {}, {}};
  channel.uints.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0u);
  if (mask.bits() == 0) return channel;
  auto to = channel.uints.begin();
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) *to++ = mask.get(x, y);
  return channel;
}

nlohmann::json vec3_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

const char* kind_name(Light::Kind kind) {
  switch (kind) {
    case Light::Kind::point:
      return "point";
    case Light::Kind::directional:
      return "directional";
    case Light::Kind::spot:
      return "spot";
  }
  return "";
}

// Rows of a matrix for column vectors.
glm::mat4 from_rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
  return glm::mat4(glm::transpose(glm::dmat4(x, y, z, w)));
}

// The row that gives (p_world - eye) . axis
glm::dvec4 along(const glm::vec3& axis, const glm::vec3& eye) {
  return {glm::dvec3(axis), -glm::dot(glm::dvec3(axis), glm::dvec3(eye))};
}

void add_attributes(ExrFile& exr, const FrameOutput& frame) {
  exr.attributes["worldToCamera"] = world_to_camera(frame.camera);
  exr.attributes["worldToNDC"] = world_to_ndc(frame.camera, frame.size);
  exr.attributes["pinocchio.version"] = std::string(version());
  exr.attributes["pinocchio.plan"] = frame.plan_json;
  exr.attributes["pinocchio.lights"] = lights_json(frame.scene);
  if (frame.render_s) exr.attributes["renderTimeSeconds"] = static_cast<float>(*frame.render_s);
}

}  // namespace

ExrFile frame_exr(const FrameOutput& frame, const AovSet& aovs) {
  ExrFile exr;
  exr.display_size = frame.size;
  exr.data_window = frame.part;
  add_attributes(exr, frame);
  add_vector(exr, frame.color, Type::half, {"R", "G", "B", "A"});
  const auto wanted = [&aovs](const char* layer) { return aovs.count(layer) > 0; };
  if (wanted("Z")) {
    const auto z_eye = frame.surfaces.z_eye.pixels();
    exr.channels.push_back({"Z", Type::real, {z_eye.begin(), z_eye.end()}, {}});
  }
  if (wanted("P")) add_vector(exr, frame.surfaces.p_world, Type::real, {"P.X", "P.Y", "P.Z"});
  if (wanted("N")) add_vector(exr, frame.surfaces.n_shading, Type::half, {"N.X", "N.Y", "N.Z"});
  if (wanted("Albedo"))
    add_vector(exr, frame.surfaces.albedo, Type::half, {"Albedo.R", "Albedo.G", "Albedo.B"});
  if (wanted("id")) {
    const auto ids = frame.ids.pixels();
    exr.channels.push_back({"id.triangle", Type::uint, {}, {ids.begin(), ids.end()}});
  }
  if (wanted("shadow")) exr.channels.push_back(mask_channel(frame.mask, frame.part.size()));
  if (wanted("reflection")) {
    const Image<glm::vec3> none(frame.reflection.empty() ? frame.part.size() : glm::ivec2(0),
                                glm::vec3(0.0f));
    add_vector(exr, frame.reflection.empty() ? none : frame.reflection, Type::half,
               {"reflection.R", "reflection.G", "reflection.B"});
  }
  return exr;
}

glm::mat4 world_to_camera(const Camera& camera) {
  const CameraAxes axes = camera_axes(camera);
  return from_rows(along(axes.right, camera.eye), along(axes.up, camera.eye), along(axes.forward, camera.eye),
                   {0, 0, 0, 1});
}

glm::mat4 world_to_ndc(const Camera& camera, glm::ivec2 size) {
  const CameraAxes axes = camera_axes(camera);
  const double height = 2.0 * std::tan(glm::radians(static_cast<double>(camera.fov_deg)) * 0.5);
  const double width = height * size.x / size.y;
  const glm::dvec4 z = along(axes.forward, camera.eye);
  return from_rows(along(axes.right, camera.eye) / width + 0.5 * z,
                   0.5 * z - along(axes.up, camera.eye) / height, {0, 0, 0, 1}, z);
}

std::string lights_json(const Scene& scene) {
  nlohmann::json lights = nlohmann::json::array();
  for (const int i : casting_lights(scene)) {
    const Light& light = scene.lights[static_cast<std::size_t>(i)];
    nlohmann::json json{{"name", light.name}, {"kind", kind_name(light.kind)}};
    if (light.kind != Light::Kind::directional) json["position"] = vec3_json(light.position);
    if (light.kind != Light::Kind::point) json["direction"] = vec3_json(light.direction);
    lights.push_back(std::move(json));
  }
  return lights.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace pinocchio
