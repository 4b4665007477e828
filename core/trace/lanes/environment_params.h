#pragma once

#include <glm/glm.hpp>

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
        shines(scene.environment_strength > 0.0f && !scene.environment->is_black()) {}

  const glm::vec3* pixels;
  glm::ivec2 size;
  float turn;  // about +Y, revolutions
  float strength;
  Environment::Shares shares;
  bool shines;
};

}  // namespace pinocchio
