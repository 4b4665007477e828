#pragma once

#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// What lies above the base of a surface of glTF's: KHR_materials_clearcoat and KHR_materials_sheen. Numbers
// alone, which shading reads in this order (shaders/shared/layers.glsl).
struct GltfLayers {
  float coat = 0.0f;
  float coat_roughness = 0.0f;
  glm::vec3 sheen{0.0f};
  float sheen_roughness = 0.0f;

  [[nodiscard]] bool any() const { return coat > 0.0f || sheen.x + sheen.y + sheen.z > 0.0f; }

  friend bool operator==(const GltfLayers&, const GltfLayers&) = default;
};

}  // namespace pinocchio
