#pragma once

#include <cstddef>

#include "core/trace/rays/ray_queue.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

// Whether neighbouring rays go to places that are many triangles apart, so that packets would share little of
// their way; judged by a sample. triangle_size: about the length of a triangle's sides.
[[nodiscard]] bool rays_part(const RayColumns& rays, std::size_t n, const Bounds& scene, float triangle_size);

}  // namespace pinocchio
