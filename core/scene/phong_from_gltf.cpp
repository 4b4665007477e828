#include "core/scene/phong_from_gltf.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace pinocchio {
namespace {

constexpr float kRoughestMirror = 0.25f;
constexpr float kLeastReflectance = 1.0f / 255.0f;  // weaker mirrors are not worth a ray

float shininess_of(float roughness) {
  const float r2 = roughness * roughness;
  return std::clamp(0.25f * (2.0f / std::max(r2 * r2, 1e-8f) - 2.0f), 1.0f, 10000.0f);
}

float largest(const glm::vec3& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

Material phong_from_gltf(const GltfSurface& s) {
  Material m;
  m.emission = s.emissive;
  if (s.unlit) {
    m.ambient = m.diffuse = glm::vec3(0.0f);
    m.emission += s.base_color;
    return m;
  }
  const float root = (s.ior - 1.0f) / (s.ior + 1.0f);
  const glm::vec3 dielectric_f0 = glm::min(root * root * s.specular * s.specular_color, glm::vec3(1.0f));
  const glm::vec3 f0 = glm::mix(dielectric_f0, s.base_color, s.metallic);
  const float opaque = (1.0f - s.metallic) * (1.0f - s.transmission);
  m.ambient = s.base_color * (1.0f - s.transmission);
  m.diffuse = s.base_color * (1.0f - largest(dielectric_f0)) * opaque * glm::one_over_pi<float>();
  m.shininess = shininess_of(s.roughness);
  m.specular = f0 * (m.shininess + 2.0f) * (0.5f * glm::one_over_pi<float>());
  if (s.transmission > 0.0f && s.metallic < 1.0f) {
    m.transmittance = s.base_color * (s.transmission * (1.0f - s.metallic));
    m.ior = s.volume ? s.ior : 1.0f;
    return m;
  }
  const float sharp = std::max(0.0f, 1.0f - s.roughness / kRoughestMirror);
  const glm::vec3 mirror = f0 * sharp * sharp;
  if (largest(mirror) > kLeastReflectance) {
    m.reflectance = mirror;
    m.fresnel = true;
  }
  return m;
}

}  // namespace pinocchio
