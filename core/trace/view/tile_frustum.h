#pragma once

#include <array>
#include <glm/glm.hpp>

#include "core/bsp/scene_trees.h"
#include "core/shade/shared.h"
#include "pinocchio/bounds.h"
#include "pinocchio/pixel_box.h"

namespace pinocchio {

// The space between the camera's rays of a tile and a pixel around it, which is more than rounding moves
// them.
class TileFrustum {
 public:
  TileFrustum(const shared::ViewParams& view, const PixelBox& tile);

  // Whether no ray of the tile comes near the box. May be false where that is so.
  [[nodiscard]] bool misses(const Bounds& box) const;

 private:
  struct Plane {
    glm::dvec3 inward{0.0};
    double offset = 0.0;  // of the points on it: dot(inward, p_world)
  };
  std::array<Plane, 4> planes_;
  double reach_ = 0.0;  // the greatest coordinate of where the rays begin
};

// Whether no triangle is near the tile's rays, as far as a few boxes of the trees tell.
[[nodiscard]] bool misses(const TileFrustum& frustum, const SceneTrees& trees);

}  // namespace pinocchio
