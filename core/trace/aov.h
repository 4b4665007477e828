#pragma once

#include <cstdint>

#include "core/trace/footprint.h"
#include "core/trace/shared.h"
#include "pinocchio/image.h"
#include "pinocchio/mesh.h"
#include "pinocchio/ray.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

// What a pixel sees; as it stands where nothing is hit.
struct VisiblePoint {
  float z_eye = kInfinity;  // along the view axis, scene units
  glm::vec3 p_world{0.0f}, n_shading{0.0f}, albedo{0.0f};
};

class VisiblePoints {
 public:
  VisiblePoints(const Mesh& mesh, const shared::ViewParams& view, bool filter_textures);

  // Without the albedo, which is undefined then, it takes less time.
  [[nodiscard]] VisiblePoint at(std::uint32_t triangle, int x, int y, bool with_albedo = true) const;

 private:
  const Mesh& mesh_;
  const shared::ViewParams& view_;
  glm::vec3 forward_;
  Footprint footprint_;
};

// Of the lines [y0, y1).
[[nodiscard]] SurfaceImages surface_images(const Mesh& mesh, const shared::ViewParams& view,
                                           const Image<std::uint32_t>& ids, int y0, int y1,
                                           bool filter_textures = true);

}  // namespace pinocchio
