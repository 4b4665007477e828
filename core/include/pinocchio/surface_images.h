#pragma once

#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"

namespace pinocchio {

// What the visible point of each pixel is like, beside its colour; all from the triangle's id.
struct SurfaceImages {
  Image<float> z_eye;          // along the view axis; +inf where nothing is hit
  Image<glm::vec3> p_world;    // 0 where nothing is hit, as the next two
  Image<glm::vec3> n_shading;  // unit
  Image<glm::vec3> albedo;     // diffuse colour, linear
};

}  // namespace pinocchio
