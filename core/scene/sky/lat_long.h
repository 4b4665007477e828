// Pictures in latitude and longitude, as Environment has them.
#pragma once

#include <glm/glm.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// The means of the picture's interpolated light over the texels of a picture of that size.
[[nodiscard]] Image<glm::vec3> reduced(const Image<glm::vec3>& picture, glm::ivec2 size);

// The means of the picture's texels over larger ones: not interpolated, so that no light is lost. The size is
// at most the picture's.
[[nodiscard]] Image<glm::vec3> area_means(const Image<glm::vec3>& picture, glm::ivec2 size);

}  // namespace pinocchio
