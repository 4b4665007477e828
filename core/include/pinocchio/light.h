#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <string_view>

#include "pinocchio/conversion.h"
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

  [[nodiscard]] bool has_size() const;

  friend bool operator==(const Light&, const Light&) = default;
};

// A length or angle that gives a light its size. 0: shadows are sharp.
struct LightSize {
  float Light::*value;
  std::string_view name;      // in extras.pinocchio of glTF, in Python and in the window
  std::string_view exr_name;  // in the lights of an EXR's header
  std::string_view what;      // in the window
  float largest;
};
inline constexpr float kAnyLength = std::numeric_limits<float>::infinity();
inline constexpr std::array kLightSizes{
    LightSize{.value = &Light::radius,
              .name = "radius",
              .exr_name = "radius",
              .what = "radius of the light, in the scene's units",
              .largest = kAnyLength},
    LightSize{.value = &Light::angle_deg,
              .name = "angle",
              .exr_name = "angleDegrees",
              .what = "diameter of its disc in degrees, 0.53 for the sun",
              .largest = 180.0f},
};

// What a light of this kind has. kLightKinds has a row for each kind, in the order of Light::Kind.
struct LightKind {
  Light::Kind kind;
  std::string_view name;
  std::string_view gltf_type;  // in KHR_lights_punctual. Another than `name`: only our extras name the kind
  bool has_position = false, has_direction = false, has_cone = false;
  bool has_sides = false;           // edge_u and edge_v, which are its size
  const LightSize* size = nullptr;  // null: the sides
};
inline constexpr std::array kLightKinds{
    LightKind{.kind = Light::Kind::point,
              .name = "point",
              .gltf_type = "point",
              .has_position = true,
              .size = &kLightSizes[0]},
    LightKind{.kind = Light::Kind::directional,
              .name = "directional",
              .gltf_type = "directional",
              .has_direction = true,
              .size = &kLightSizes[1]},
    LightKind{.kind = Light::Kind::spot,
              .name = "spot",
              .gltf_type = "spot",
              .has_position = true,
              .has_direction = true,
              .has_cone = true,
              .size = &kLightSizes[0]},
    LightKind{.kind = Light::Kind::rectangle,
              .name = "rectangle",
              .gltf_type = "point",
              .has_position = true,
              .has_direction = true,
              .has_sides = true},
};

[[nodiscard]] constexpr const LightKind& kind_of(const Light& light) {
  return kLightKinds[as_size(light.kind)];
}

inline bool Light::has_size() const {
  const LightKind& row = kind_of(*this);
  return row.has_sides || this->*row.size->value > 0.0f;
}

}  // namespace pinocchio
