#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

// True if neighbouring rays are mostly further apart than `apart` at the scene's center: packets of them
// would share little of their way. Looks at a sample of the rays.
[[nodiscard]] bool rays_part(const RayColumns& rays, std::size_t n, const glm::vec3& center, float apart);

}  // namespace pinocchio
