#pragma once

#include <array>
#include <glm/glm.hpp>

#include "core/bsp/scene_trees.h"
#include "core/shade/shared.h"
#include "pinocchio/bounds.h"
#include "pinocchio/pixel_box.h"

namespace pinocchio {

// The space that the camera's rays of a tile go through, and a pixel around it: far more than rounding moves
// rays.
class TileFrustum {
 public:
  TileFrustum(const shared::ViewParams& view, const PixelBox& tile);

  // True only if all rays pass the box by.
  [[nodiscard]] bool misses(const Bounds& box) const;

 private:
  struct Plane {
    glm::dvec3 inward{0.0};
    double offset = 0.0;  // of the points on it: dot(inward, p_world)
  };
  std::array<Plane, 4> planes_;
  double reach_ = 0.0;  // the greatest coordinate of where the rays begin
};

// True only if all rays pass all triangles by. It looks at a few boxes of the trees, so that it may be false
// even then.
[[nodiscard]] bool misses(const TileFrustum& frustum, const SceneTrees& trees);

}  // namespace pinocchio
