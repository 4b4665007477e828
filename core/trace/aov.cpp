#include "core/trace/aov.h"

#include "core/parallel/tiles.h"
#include "core/trace/surface.h"
#include "core/trace/view_params.h"

namespace pinocchio {

SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view, Workers& workers,
                             const Image<std::uint32_t>& ids) {
  const glm::ivec2 size = ids.size();
  SurfaceImages images{Image<float>(size, kInfinity), Image<glm::vec3>(size, glm::vec3(0.0f)),
                       Image<glm::vec3>(size, glm::vec3(0.0f)), Image<glm::vec3>(size, glm::vec3(0.0f))};
  const glm::vec3 forward = view_axis(view);
  const TileGrid grid(size);
  workers.for_each(grid.count(), [&](std::size_t i) {
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const std::size_t pixel = ids.index(x, y);
      if (ids[pixel] == kNoTriangle) return;
      const Ray ray = pixel_ray(view, x, y);
      const SurfaceInteraction s = surface_at(mesh, ids[pixel], ray.origin, ray.direction);
      images.z_eye[pixel] = glm::dot(s.p_world - view.eye, forward);
      images.p_world[pixel] = s.p_world;
      images.n_shading[pixel] = s.n_shading;
      images.albedo[pixel] = s.phong.diffuse;
    });
  });
  return images;
}

}  // namespace pinocchio
