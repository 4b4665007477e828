#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <string>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

struct Light {
  enum class Kind { point, directional, spot, rectangle };
  enum class Falloff { none, inverse_square };  // none: same strength at any distance, as Phong has it

  std::string name;
  Kind kind = Kind::point;
  glm::vec3 position{0.0f};                // point, spot, rectangle (its centre); world space
  glm::vec3 direction{0.0f, -1.0f, 0.0f};  // unit; directional, spot: the light travels along it; rectangle:
                                           // the one side that shines faces it
  glm::vec3 color{1.0f};                   // linear
  float intensity = 1.0f;                  // multiplies colour
  Falloff falloff = Falloff::none;
  float range = std::numeric_limits<float>::infinity();  // no light reaches beyond; scene units
  float cos_inner = 1.0f;                                // spot: full strength inside this cone ...
  float cos_outer = -1.0f;                               // ... none outside this one
  bool casts_shadow = true;

  // Its size (shaders/shared/sized_light.glsl): each sample of a picture takes one point of it, so that many
  // have soft shadows. In all it is as bright as without. Scene units.
  float radius = 0.0f;                   // point, spot: of the ball that shines
  float angle_deg = 0.0f;                // directional: diameter of its disc, as the sun's 0.53
  glm::vec3 edge_u{0.0f}, edge_v{0.0f};  // rectangle: its sides, across `direction`

  [[nodiscard]] bool has_size() const {
    return kind == Kind::rectangle || (kind == Kind::directional ? angle_deg > 0.0f : radius > 0.0f);
  }

  friend bool operator==(const Light&, const Light&) = default;
};

// Mask slots: casting lights in scene order, one bit each.
inline constexpr int kMaxCastingLights = 8;

}  // namespace pinocchio
