#include "core/trace/tiles/motion.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// A point of the triangle by its weights, in double precision: pixels are small.
glm::dvec3 point_at(const Mesh& mesh, std::uint32_t triangle, const glm::dvec2& weights) {
  const glm::uvec3& corners = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
  return a + weights.x * (b - a) + weights.y * (c - a);
}

// The weights of the second and third corner where the ray meets the triangle's plane.
std::optional<glm::dvec2> weights_of(const Mesh& mesh, std::uint32_t triangle, const Ray& ray) {
  const glm::uvec3& corners = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), ab = glm::dvec3(mesh.positions[corners.y]) - a,
                                                 ac = glm::dvec3(mesh.positions[corners.z]) - a;
  const glm::dvec3 direction(ray.direction), across = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 from_a = glm::dvec3(ray.origin) - a;
  return glm::dvec2(glm::dot(from_a, across), glm::dot(direction, glm::cross(from_a, ab))) / determinant;
}

// From one place in the picture to the other, pixels. A panorama's left and right edges are one: the shorter
// way counts.
glm::dvec2 way_between(const glm::dvec2& from, const glm::dvec2& to, const Camera& camera, int width) {
  glm::dvec2 way = to - from;
  if (camera.projection == Projection::panorama) way.x -= width * std::round(way.x / width);
  return way;
}

}  // namespace

void write_motion(const Mesh& mesh, const View& view, const MotionTo& other, const PixelBox& tile,
                  const std::uint32_t* ids, std::size_t ids_width, glm::vec2* to, std::size_t first,
                  std::size_t width) {
  constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
  const std::optional<RayModel> model = RayModel::of(view);
  const shared::ViewParams params = view_params(view);
  const Mesh& there = other.mesh ? *other.mesh : mesh;
  const glm::ivec2 size = tile.size();
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::uint32_t triangle = ids[as_size(y) * ids_width + as_size(x)];
      glm::vec2& motion = to[first + as_size(y) * width + as_size(x)];
      motion = glm::vec2(0.0f);
      if (triangle == kNoTriangle) continue;
      const glm::ivec2 pixel = tile.lo + glm::ivec2(x, y);
      const Ray ray = model ? model->ray(pixel.x, pixel.y) : pixel_ray(params, pixel.x, pixel.y);
      const std::optional<glm::dvec2> weights = weights_of(mesh, triangle, ray);
      if (!weights) continue;
      const std::optional<glm::dvec2> here =
          pixel_of(view.camera, view.size, point_at(mesh, triangle, *weights));
      const std::optional<glm::dvec2> then =
          pixel_of(other.camera, view.size, point_at(there, triangle, *weights));
      motion =
          here && then ? glm::vec2(way_between(*here, *then, other.camera, view.size.x)) : glm::vec2(kUnseen);
    }
}

}  // namespace pinocchio
