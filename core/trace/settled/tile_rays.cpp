#include "core/trace/settled/tile_rays.h"

#include <algorithm>

#include "core/parallel/tiles.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

TileRays::TileRays(const shared::ViewParams& view, glm::ivec2 corner, const Footprint& of_pixel)
    : parallel(view.parallel),
      step_x(view.step_x),
      step_y(view.step_y),
      footprint(std::max(glm::length(of_pixel.step_x), glm::length(of_pixel.step_y))) {
  const glm::dvec2 pixel = glm::dvec2(corner) + glm::dvec2(view.first);
  const glm::dvec3 x(step_x), y(step_y), moved = pixel.x * x + pixel.y * y;
  const glm::dvec3 first = glm::dvec3(view.corner) + (parallel ? glm::dvec3(0.0) : moved);
  origin = glm::vec3(glm::dvec3(view.eye) + (parallel ? moved : glm::dvec3(0.0)));
  direction = glm::vec3(first);
  const double side = parallel ? 0.0 : TileGrid::kTileSize;
  const double most = std::max({glm::length(first), glm::length(first + side * x),
                                glm::length(first + side * y), glm::length(first + side * (x + y))});
  longest = as_float(1.001 * most);
}

}  // namespace pinocchio
