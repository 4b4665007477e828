#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <string>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

struct Light {
  enum class Kind { point, directional, spot, rectangle };
  enum class Falloff { none, inverse_square };  // none: the same strength at any distance (Phong)

  std::string name;
  Kind kind = Kind::point;
  glm::vec3 position{0.0f};                // point, spot, rectangle (its centre); world space
  glm::vec3 direction{0.0f, -1.0f, 0.0f};  // unit; directional, spot: the light's direction of travel;
                                           // rectangle: the shining side faces it
  glm::vec3 color{1.0f};                   // linear
  float intensity = 1.0f;                  // multiplies `color`
  Falloff falloff = Falloff::none;
  float range = std::numeric_limits<float>::infinity();  // no light reaches beyond; scene units
  float cos_inner = 1.0f;                                // spot: full strength inside this cone ...
  float cos_outer = -1.0f;                               // ... none outside this one
  bool casts_shadow = true;

  // The light's size (shaders/shared/sized_light.glsl): each sample of a picture takes one point of the
  // light, so that many samples give soft shadows. The size does not change the light's power. Scene units.
  float radius = 0.0f;                   // point, spot: of the shining sphere
  float angle_deg = 0.0f;                // directional: diameter of the disc; the sun's is 0.53
  glm::vec3 edge_u{0.0f}, edge_v{0.0f};  // rectangle: the sides, at right angles to `direction`

  [[nodiscard]] bool has_size() const {
    return kind == Kind::rectangle || (kind == Kind::directional ? angle_deg > 0.0f : radius > 0.0f);
  }

  friend bool operator==(const Light&, const Light&) = default;
};

// Mask slots, one bit each: the casting lights in scene order.
inline constexpr int kMaxCastingLights = 8;

}  // namespace pinocchio
