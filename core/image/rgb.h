#pragma once

#include <glm/glm.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// A picture without its alpha.
[[nodiscard]] Image<glm::vec3> rgb_of(const Image<glm::vec4>& picture);

// The same for error figures, which need finite numbers: pixels that are not finite become black.
[[nodiscard]] Image<glm::vec3> finite_rgb_of(const Image<glm::vec4>& picture);

// Adds an alpha of 1.
[[nodiscard]] Image<glm::vec4> opaque(const Image<glm::vec3>& rgb);

}  // namespace pinocchio
