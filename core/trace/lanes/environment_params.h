#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <memory>

#include "core/scene/sky/prefiltered_sky.h"
#include "pinocchio/conversion.h"
#include "pinocchio/environment.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A scene's environment as rays read it (lanes/environment_light.h).
struct EnvironmentLight {
  // The environment must outlive this object.
  EnvironmentLight(const Environment& environment, float rotation_deg, float factor)
      : pixels(environment.radiance().pixels().data()),
        size(environment.radiance().size()),
        turn(rotation_deg / 360.0f),
        strength(factor),
        shares(environment.shares()),
        brightness(environment.brightness()),
        shines(factor > 0.0f && !environment.is_black()),
        cos_turn(as_float(std::cos(glm::radians(double{rotation_deg})))),
        sin_turn(as_float(std::sin(glm::radians(double{rotation_deg})))) {}
  // The scene has an environment.
  explicit EnvironmentLight(const Scene& scene)
      : EnvironmentLight(*scene.environment, scene.environment_rotation_deg, scene.environment_strength) {}

  const glm::vec3* pixels;
  glm::ivec2 size;
  float turn;  // about +Y, revolutions
  float strength;
  Environment::Shares shares;
  const std::uint32_t* brightness;
  bool shines;
  float cos_turn, sin_turn;
  std::shared_ptr<const PrefilteredSky> prefiltered;  // null: nothing reads it
};

}  // namespace pinocchio
