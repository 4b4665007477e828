#include "app/window/camera/framing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pinocchio/view.h"

namespace pinocchio::app {
namespace {

constexpr float kFlat = 1e-4f;  // of the box's diagonal

// Whether the triangle lies in one of the box's six faces.
bool is_wall(const std::array<glm::vec3, 3>& p, const Bounds& box, float flat) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {box.lo[axis], box.hi[axis]})
      if (std::ranges::all_of(p, [&](const glm::vec3& v) { return std::abs(v[axis] - side) <= flat; }))
        return true;
  return false;
}

}  // namespace

Bounds bounds_of_interest(const Mesh& mesh) {
  const Bounds& all = mesh.bounds();
  const float flat = kFlat * all.diagonal();
  Bounds inner;
  for (const glm::uvec3& t : mesh.triangles) {
    const std::array<glm::vec3, 3> p{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    if (is_wall(p, all, flat)) continue;
    for (const glm::vec3& v : p) inner.add(v);
  }
  return inner.empty() ? all : inner;
}

Camera before_walls(Camera camera, const Bounds& seen, const Tracer& tracer) {
  constexpr float kOff = 0.98f;
  const glm::vec3 to_eye = camera.eye - camera.target;
  const float distance = glm::length(to_eye), radius = std::min(0.5f * seen.diagonal(), 0.9f * distance);
  const glm::vec3 direction = to_eye / std::max(distance, 1e-30f);
  const std::array<Ray, 1> ray{Ray{camera.target + radius * direction, distance - radius, direction}};
  std::array<Hit, 1> hit{};
  tracer.closest_hits(ray, hit);
  if (!hit[0].valid()) return camera;
  camera.eye = camera.target + direction * (radius + kOff * hit[0].t);
  return camera;
}

std::optional<glm::vec3> surface_under(glm::vec2 pixel, glm::vec2 screen, const Camera& camera,
                                       const Tracer& tracer, Backfaces backfaces) {
  const glm::ivec2 size = glm::max(glm::ivec2(screen), 1),
                   at = glm::clamp(glm::ivec2(pixel), glm::ivec2(0), size - 1);
  const Image<Ray> rays = camera_rays({camera, size, {at, at + 1}});
  std::array<Hit, 1> hit{};
  tracer.closest_hits(rays.pixels(), hit, backfaces);
  if (!hit[0].valid()) return std::nullopt;
  return rays[0].origin + hit[0].t * rays[0].direction;
}

}  // namespace pinocchio::app
