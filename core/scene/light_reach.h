#pragma once

#include "pinocchio/scene.h"

namespace pinocchio {

// Whether the light may reach any of the scene, at any time of its animation: the settings of all frames of
// an animation have to be the same.
[[nodiscard]] inline bool may_reach(const Light& light, const Scene& scene) {
  if (!scene.animation) return reaches(light, scene.mesh->bounds());
  return light.color * light.intensity != glm::vec3(0.0f);
}

}  // namespace pinocchio
