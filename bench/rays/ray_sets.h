#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/parallel/workers.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

enum class Query { closest, any };

// Rays of one kind out of one frame, in the order in which the renderer traces them.
struct RaySet {
  std::string name;
  Query query = Query::closest;
  std::vector<Ray> rays;
};

// The rays of the scene's first camera (or one that has the whole scene in view) at `size` pixels:
// "primary"; "shadow", from every visible point to each casting light; "reflection", mirrored once;
// "second bounce", mirrored twice. Refracted rays are left out. A set may be empty.
[[nodiscard]] std::vector<RaySet> frame_ray_sets(const Scene& scene, const Tracer& tracer, glm::ivec2 size);

}  // namespace pinocchio::bench
