#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <memory>

#include "core/scene/prefiltered_sky.h"
#include "pinocchio/environment.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A scene's environment as rays read it (lanes/environment_light.h).
struct EnvironmentLight {
  // The scene has an environment.
  explicit EnvironmentLight(const Scene& scene)
      : pixels(scene.environment->radiance().pixels().data()),
        size(scene.environment->radiance().size()),
        turn(scene.environment_rotation_deg / 360.0f),
        strength(scene.environment_strength),
        shares(scene.environment->shares()),
        shines(scene.environment_strength > 0.0f && !scene.environment->is_black()),
        cos_turn(static_cast<float>(std::cos(glm::radians(double{scene.environment_rotation_deg})))),
        sin_turn(static_cast<float>(std::sin(glm::radians(double{scene.environment_rotation_deg})))) {}

  const glm::vec3* pixels;
  glm::ivec2 size;
  float turn;  // about +Y, revolutions
  float strength;
  Environment::Shares shares;
  bool shines;
  float cos_turn, sin_turn;
  std::shared_ptr<const PrefilteredSky> prefiltered;  // null: nothing reads it
};

}  // namespace pinocchio
