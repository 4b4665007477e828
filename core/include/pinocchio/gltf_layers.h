#pragma once

#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// The layers above the base of a glTF surface: KHR_materials_clearcoat and KHR_materials_sheen. It holds
// nothing but floats, which shaders/shared/layers.glsl reads in this order.
struct GltfLayers {
  float coat = 0.0f;  // factor, 0 to 1
  float coat_roughness = 0.0f;
  glm::vec3 sheen{0.0f};  // colour, linear
  float sheen_roughness = 0.0f;

  [[nodiscard]] bool any() const { return coat > 0.0f || sheen.x + sheen.y + sheen.z > 0.0f; }

  friend bool operator==(const GltfLayers&, const GltfLayers&) = default;
};

}  // namespace pinocchio
