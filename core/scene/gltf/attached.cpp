#include "core/scene/gltf/attached.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <ranges>
#include <string_view>

#include "core/math/finite.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

glm::vec3 direction_of(const glm::mat4& world, const glm::vec3& local) {
  const glm::vec3 d(world * glm::vec4(local, 0.0f));
  const float length = glm::length(d);
  return length > 0.0f ? d / length : local;
}

std::optional<float> length_member(const Json* extras, const char* key) {
  const std::optional<float> size = value_member<float>(extras, key);
  return size && *size >= 0.0f && std::isfinite(*size) ? size : std::nullopt;
}

// The kind of glTF's `type`; null: glTF has no such type.
const LightKind* kind_of_type(std::string_view type) {
  const auto* const found = std::ranges::find(kLightKinds, type, &LightKind::gltf_type);
  return found == kLightKinds.end() ? nullptr : found;
}

// Applies our extras to a light. The sides of an area light lie along the node's x and y axes.
void add_extras(const Json* extras, const glm::mat4& world, Light& light) {
  light.casts_shadow = value_member<bool>(extras, "castsShadow").value_or(light.casts_shadow);
  for (const LightSize& size : kLightSizes)
    if (const std::optional<float> value = length_member(extras, std::string(size.name).c_str()))
      light.*size.value = std::min(*value, size.largest);
  for (const LightKind& kind : kLightKinds) {
    if (!kind.has_sides) continue;
    const std::optional<glm::vec2> sides = value_member<glm::vec2>(extras, std::string(kind.name));
    if (!sides) continue;
    light.kind = kind.kind;
    light.edge_u = glm::vec3(world * glm::vec4(sides->x, 0.0f, 0.0f, 0.0f));
    light.edge_v = glm::vec3(world * glm::vec4(0.0f, sides->y, 0.0f, 0.0f));
  }
  if (text_member(extras, "falloff") == "none") light.falloff = Light::Falloff::none;
}

}  // namespace

bool is_light_type(std::string_view type) {
  return kind_of_type(type) != nullptr;
}

Light light_of(const Json& json, const GltfNode& node, const glm::mat4& world) {
  Light light;
  light.name = text_member(&json, "name");
  if (light.name.empty()) light.name = node.name;
  const LightKind* const given = kind_of_type(text_member(&json, "type"));
  const LightKind& kind = given ? *given : kLightKinds.front();
  light.kind = kind.kind;
  light.position = glm::vec3(world[3]);
  light.direction = direction_of(world, {0, 0, -1});
  if (const std::vector<double> color = numbers_member(&json, "color"); color.size() == 3)
    light.color = glm::make_vec3(color.data());
  light.intensity = value_member<float>(&json, "intensity").value_or(1.0f);
  light.falloff = kind.has_position ? Light::Falloff::inverse_square : Light::Falloff::none;
  if (const double range = value_member<double>(&json, "range").value_or(0.0); range > 0.0)
    light.range = as_float(range);
  if (kind.has_cone) {
    const Json* spot = member(&json, "spot");
    constexpr double kUsualCone = 0.7853981634;
    light.cos_inner = as_float(std::cos(value_member<double>(spot, "innerConeAngle").value_or(0.0)));
    light.cos_outer = as_float(std::cos(value_member<double>(spot, "outerConeAngle").value_or(kUsualCone)));
  }
  for (const Json* extras : {our_extras(&json), our_extras(node.json)}) add_extras(extras, world, light);
  return light;
}

// Ahead of the eye, so far that the direction does not drown in the rounding of large coordinates.
glm::vec3 target_of(const glm::vec3& eye, const glm::vec3& direction) {
  constexpr float kLeastShare = 1.0f / 1024.0f;  // of the coordinates: 6e-5 radians
  const glm::vec3 size = glm::abs(eye);
  return eye + std::max(1.0f, kLeastShare * std::max({size.x, size.y, size.z})) * direction;
}

Camera camera_of(const Json& json, const GltfNode& node, const glm::mat4& world) {
  Camera camera;
  camera.name = !node.name.empty() ? node.name : text_member(&json, "name");
  camera.eye = glm::vec3(world[3]);
  camera.target = target_of(camera.eye, direction_of(world, {0, 0, -1}));
  camera.up = direction_of(world, {0, 1, 0});
  const Json* const extras = our_extras(node.json);
  const std::optional<glm::vec3> target = value_member<glm::vec3>(extras, "target");
  if (target && *target != camera.eye) camera.target = *target;
  const std::optional<glm::vec3> up = value_member<glm::vec3>(extras, "up");
  if (up && *up != glm::vec3(0.0f)) camera.up = *up;
  if (text_member(&json, "type") == "orthographic") {
    camera.projection = Projection::orthographic;
    camera.height = 2.0f * value_member<float>(member(&json, "orthographic"), "ymag").value_or(0.0f);
  } else {
    const double yfov = value_member<double>(member(&json, "perspective"), "yfov").value_or(0.0);
    camera.fov_deg = as_float(glm::degrees(yfov));
  }
  camera.lens_radius = length_member(extras, "lensRadius").value_or(0.0f);
  camera.focus_distance = length_member(extras, "focusDistance").value_or(0.0f);
  return camera;
}

Light at_rest(const glm::mat4& world, const Light& light) {
  Light rest = light;
  place(Placement(glm::inverse(world)), light, rest);
  rest.position = glm::vec3(0.0f);
  rest.direction = {0, 0, -1};
  return rest;
}
Camera at_rest(const glm::mat4& world, const Camera& camera) {
  Camera rest = camera;
  place(Placement(glm::inverse(world)), camera, rest);
  rest.eye = glm::vec3(0.0f);
  return rest;
}

bool can_shine(const Light& light) {
  return is_finite(light.position) && is_finite(light.direction) && is_finite(light.edge_u) &&
         is_finite(light.edge_v) && is_finite(light.intensity * light.color);
}

}  // namespace pinocchio
