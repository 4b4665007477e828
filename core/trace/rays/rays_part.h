#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

// Whether neighbouring rays are further apart than that at the scene's center, so that packets would share
// little of their way; judged by a sample.
[[nodiscard]] bool rays_part(const RayColumns& rays, std::size_t n, const glm::vec3& center, float apart);

}  // namespace pinocchio
