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

// The rays of one raytraced frame, of the scene's first camera (or one that has the whole scene in view), by
// generation: "primary"; "shadow", of visible points; "reflection" and "shadow of reflection", mirrored or
// refracted once; "second bounce" and its shadow; and so on. A kind that the frame has none of is left out.
[[nodiscard]] std::vector<RaySet> frame_ray_sets(const Scene& scene, const Tracer& tracer, glm::ivec2 size);

}  // namespace pinocchio::bench
