#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

// True if neighbouring rays are mostly further apart than `apart` (scene units) at the scene's centre: a
// packet of them would share little of its way. Judged by a sample of the rays.
[[nodiscard]] bool are_incoherent(const RayColumns& rays, std::size_t n, const glm::vec3& center,
                                  float apart);

}  // namespace pinocchio
