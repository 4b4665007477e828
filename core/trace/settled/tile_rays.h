#pragma once

#include <glm/glm.hpp>

#include "core/shade/footprint.h"
#include "core/shade/shared.h"

namespace pinocchio {

// The camera's rays through the pixels of a tile: that of pixel (x, y) of the tile starts at
// origin + x origin_x + y origin_y, and so on.
struct TileRays {
  TileRays(const shared::ViewParams& view, glm::ivec2 corner, const Footprint& of_pixel);

  glm::vec3 origin, direction;
  bool parallel;             // origins differ, else directions
  glm::vec3 step_x, step_y;  // from pixel to pixel: of that which differs
  float longest;             // at least the length of each direction
  float footprint;           // longer side of a pixel's, at t = 1; of parallel rays, anywhere
};

}  // namespace pinocchio
