#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <string>

namespace pinocchio {

struct Light {
  enum class Kind { point, directional, spot };
  enum class Falloff { none, inverse_square };  // none: same strength at any distance, as Phong has it

  std::string name;
  Kind kind = Kind::point;
  glm::vec3 position{0.0f};                // point, spot; world space
  glm::vec3 direction{0.0f, -1.0f, 0.0f};  // directional, spot: unit vector the light travels along
  glm::vec3 color{1.0f};                   // linear
  float intensity = 1.0f;                  // multiplies colour
  Falloff falloff = Falloff::none;
  float range = std::numeric_limits<float>::infinity();  // no light reaches beyond; scene units
  float cos_inner = 1.0f;                                // spot: full strength inside this cone ...
  float cos_outer = -1.0f;                               // ... none outside this one
  bool casts_shadow = true;
  float radius = 0.0f;  // point, spot: of the ball that shines; scene units

  // Whether its shadows are soft: a picture takes samples of it.
  [[nodiscard]] bool has_size() const { return radius > 0.0f; }

  friend bool operator==(const Light&, const Light&) = default;
};

// Mask slots: casting lights in scene order, one bit each.
inline constexpr int kMaxCastingLights = 8;

}  // namespace pinocchio
