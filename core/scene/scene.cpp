#include "pinocchio/scene.h"

#include <algorithm>
#include <cmath>

#include "core/scene/light_reach.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

std::vector<int> casting_lights(const Scene& scene) {
  std::vector<int> casting;
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].casts_shadow) casting.push_back(as_int(i));
  return casting;
}

std::vector<int> mask_slots(const Scene& scene) {
  std::vector<int> slots(scene.lights.size(), -1);
  int next = 0;
  for (const int light : casting_lights(scene)) slots[light] = next++;
  return slots;
}

bool reaches(const Light& light, const Bounds& box) {
  if (box.empty() || light.color * light.intensity == glm::vec3(0.0f)) return false;
  const LightKind& kind = kind_of(light);
  if (!kind.has_position) return true;
  const float sides = 0.5f * (glm::length(light.edge_u) + glm::length(light.edge_v));
  if (glm::distance(light.position, glm::clamp(light.position, box.lo, box.hi)) > light.range + sides)
    return false;
  // A ball with a cone also lights beside its axis.
  if (!kind.has_cone || light.has_size()) return true;
  // The cone against the ball around the box.
  const glm::vec3 to_center = box.center() - light.position;
  const float distance = glm::length(to_center), radius = 0.5f * box.diagonal();
  if (distance <= radius) return true;
  constexpr float kSlack = 1e-3f;  // radians: far beyond any rounding
  const float angle = std::acos(glm::clamp(glm::dot(to_center / distance, light.direction), -1.0f, 1.0f));
  return angle - std::asin(radius / distance) <= std::acos(glm::clamp(light.cos_outer, -1.0f, 1.0f)) + kSlack;
}

void drop_idle_casters(Scene& scene) {
  for (Light& light : scene.lights) light.casts_shadow = light.casts_shadow && may_reach(light, scene);
}

bool takes_samples(const Scene& scene, EnvironmentMethod sky, Glossy glossy) {
  const std::vector<Material>& materials = scene.mesh->materials;
  const bool lobes = glossy == Glossy::sampled;
  return (scene.environment && (sky == EnvironmentMethod::sampled ||
                                (lobes && std::ranges::any_of(materials, &Material::is_microfacet)))) ||
         std::ranges::any_of(scene.lights, &Light::has_size) ||
         (lobes && std::ranges::any_of(materials, &Material::is_glossy));
}

const Camera* find_camera(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                  [&name](const Camera& camera) { return camera.name == name; });
  return found == scene.cameras.end() ? nullptr : &*found;
}

Camera camera_for_whole_scene(const Scene& scene) {
  Bounds bounds = scene.mesh->bounds();
  if (bounds.empty()) bounds.add(glm::vec3(0.0f));
  // At least what single precision distinguishes from the centre: eye and target have to differ. Scenes of
  // molecules are in units of 1e-10.
  const float least = std::max(1e-6f * glm::length(bounds.center()), 1e-12f);
  const float radius = std::max(0.5f * bounds.diagonal(), least);
  Camera camera;
  camera.name = "whole scene";
  camera.target = bounds.center();
  const glm::vec3 towards_eye = glm::normalize(glm::vec3(0.5f, 0.35f, 1.0f));
  // The bounding sphere touches the upper and lower edge of a picture that is not taller than wide.
  const float distance = 1.05f * radius / std::sin(glm::radians(0.5f * camera.fov_deg));
  camera.eye = camera.target + distance * towards_eye;
  return camera;
}

Light default_light(const Scene& scene, const Camera& camera) {
  const float reach = std::max(glm::length(camera.eye - camera.target), scene.mesh->bounds().diagonal());
  const CameraAxes axes = camera_axes(camera);
  const glm::vec3 up = glm::length(camera.up) > 0.0f ? glm::normalize(camera.up) : axes.up;
  Light light;
  light.name = "default";
  light.position = camera.eye + reach * (0.4f * axes.right + 0.6f * up);
  return light;
}

}  // namespace pinocchio
