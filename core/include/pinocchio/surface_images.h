#pragma once

#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Properties of the visible point of each pixel, all computed from its triangle's id.
struct SurfaceImages {
  Image<float> z_eye;          // along the view axis; +inf where nothing is hit
  Image<glm::vec3> p_world;    // this and the next two are 0 where nothing is hit
  Image<glm::vec3> n_shading;  // unit
  Image<glm::vec3> albedo;     // share of light that is returned, linear
};

}  // namespace pinocchio
