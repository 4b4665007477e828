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

// The rays of one kind in a frame, in the renderer's order.
struct RaySet {
  std::string name;
  Query query = Query::closest;
  std::vector<Ray> rays;
};

// The rays of a raytraced frame of the scene's first camera (or of one that sees the whole scene), by
// generation: "primary"; "shadow", of visible points; "reflection" and "shadow of reflection", mirrored or
// refracted once; "second bounce" and its shadow; and so on. Kinds without rays are left out.
[[nodiscard]] std::vector<RaySet> frame_ray_sets(const Scene& scene, const Tracer& tracer, glm::ivec2 size);

// "random": rays in no order, from a sphere around the mesh to points in its box.
[[nodiscard]] RaySet random_rays(const Mesh& mesh, std::size_t count);

}  // namespace pinocchio::bench
