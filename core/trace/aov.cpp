#include "core/trace/aov.h"

#include "core/trace/surface.h"
#include "core/trace/view_params.h"

namespace pinocchio {

VisiblePoints::VisiblePoints(const Mesh& mesh, const shared::ViewParams& view, bool filter_textures)
    : mesh_(mesh), view_(view), forward_(view_axis(view)),
      footprint_(filter_textures ? Footprint::of_camera(view) : Footprint{}) {}

VisiblePoint VisiblePoints::at(std::uint32_t triangle, int x, int y, bool with_albedo) const {
  if (triangle == kNoTriangle) return {};
  const Ray ray = pixel_ray(view_, x, y);
  const SurfaceInteraction s = with_albedo || mesh_.maps_of(triangle)
                                   ? surface_at(mesh_, triangle, ray.origin, ray.direction, {}, footprint_)
                                   : bare_surface_at(mesh_, triangle, ray.origin, ray.direction);
  return {glm::dot(s.p_world - view_.eye, forward_), s.p_world, s.n_shading, s.material.phong.diffuse};
}

SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                             const Image<std::uint32_t>& ids, int y0, int y1, bool filter_textures) {
  const glm::ivec2 size{ids.width(), y1 - y0};
  SurfaceImages images{Image<float>(size), Image<glm::vec3>(size), Image<glm::vec3>(size),
                       Image<glm::vec3>(size)};
  const VisiblePoints points(mesh, view, filter_textures);
  for (int y = y0; y < y1; ++y)
    for (int x = 0; x < size.x; ++x) {
      const VisiblePoint point = points.at(ids.at(x, y), x, y);
      const std::size_t pixel = images.z_eye.index(x, y - y0);
      images.z_eye[pixel] = point.z_eye;
      images.p_world[pixel] = point.p_world;
      images.n_shading[pixel] = point.n_shading;
      images.albedo[pixel] = point.albedo;
    }
  return images;
}

}  // namespace pinocchio
