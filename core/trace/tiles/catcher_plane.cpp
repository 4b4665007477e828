#include "core/trace/tiles/catcher_plane.h"

#include <algorithm>
#include <cmath>

#include "pinocchio/conversion.h"

namespace pinocchio {

CatcherPlane::CatcherPlane(const Bounds& scene, float height) : height_(height) {
  const glm::vec3 center = scene.empty() ? glm::vec3(0.0f) : scene.center();
  reach_ = std::max(scene.empty() ? 1.0f : scene.diagonal(), 1e-6f);
  center_ = {center.x, center.z};
  float reach = reach_;
  for (std::size_t i = 0; i < kTriangles; ++i, reach *= 4.0f) {
    const auto at = [&](float x, float z) {
      return glm::vec3(center_.x + reach * x, height, center_.y + reach * z);
    };
    const auto first = as_uint32(3 * i);
    positions_[first] = at(-1.5f, -1.5f);  // the square from -1 to 1 is well inside
    positions_[first + 1] = at(-1.5f, 5.0f);
    positions_[first + 2] = at(5.0f, -1.5f);
    triangles_[i] = {first, first + 1, first + 2};
  }
  white_.ambient = white_.diffuse = glm::vec3(1.0f);
}

SceneArrays CatcherPlane::arrays() const {
  SceneArrays arrays{};
  arrays.positions = positions_.data();
  arrays.normals = normals_.data();
  arrays.triangles = triangles_.data();
  arrays.triangle_materials = triangle_materials_.data();
  arrays.materials = &white_;
  return arrays;
}

std::optional<std::uint32_t> CatcherPlane::triangle_at(const Ray& ray) const {
  if (!(ray.direction.y < 0.0f && ray.origin.y > height_)) return std::nullopt;
  const float t = (height_ - ray.origin.y) / ray.direction.y;
  const glm::vec2 at(ray.origin.x + t * ray.direction.x, ray.origin.z + t * ray.direction.z);
  const float distance = std::max(std::abs(at.x - center_.x), std::abs(at.y - center_.y));
  float reach = reach_;
  for (std::uint32_t i = 0; i < kTriangles; ++i, reach *= 4.0f)
    if (distance <= reach) return i;
  return std::nullopt;
}

}  // namespace pinocchio
