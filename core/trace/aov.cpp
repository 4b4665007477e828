#include "core/trace/aov.h"

#include "core/trace/surface.h"
#include "core/trace/view_params.h"

namespace pinocchio {

SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view, const Image<std::uint32_t>& ids,
                             int y0, int y1, bool filter_textures) {
  const glm::ivec2 size{ids.width(), y1 - y0};
  SurfaceImages images{Image<float>(size, kInfinity), Image<glm::vec3>(size, glm::vec3(0.0f)),
                       Image<glm::vec3>(size, glm::vec3(0.0f)), Image<glm::vec3>(size, glm::vec3(0.0f))};
  const glm::vec3 forward = view_axis(view);
  const Footprint footprint = filter_textures ? Footprint::of_camera(view) : Footprint{};
  for (int y = y0; y < y1; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::uint32_t id = ids.at(x, y);
      if (id == kNoTriangle) continue;
      const Ray ray = pixel_ray(view, x, y);
      const SurfaceInteraction s = surface_at(mesh, id, ray.origin, ray.direction, {}, footprint);
      const std::size_t pixel = images.z_eye.index(x, y - y0);
      images.z_eye[pixel] = glm::dot(s.p_world - view.eye, forward);
      images.p_world[pixel] = s.p_world;
      images.n_shading[pixel] = s.n_shading;
      images.albedo[pixel] = s.material.phong.diffuse;
    }
  return images;
}

}  // namespace pinocchio
