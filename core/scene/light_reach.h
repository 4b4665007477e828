#pragma once

#include "pinocchio/scene.h"

namespace pinocchio {

// Whether any of the scene may be lit by it, now or, where the scene is animated, at any other time: what
// frames of one animation are drawn by must not differ.
[[nodiscard]] inline bool may_reach(const Light& light, const Scene& scene) {
  if (!scene.animation) return reaches(light, scene.mesh->bounds());
  return light.color * light.intensity != glm::vec3(0.0f);
}

}  // namespace pinocchio
