#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// Square faces of one size towards +X, -X, +Y, -Y, +Z and -Z, seen from the cube's centre, as in glTF's
// EXT_lights_image_based. The side faces have +Y up. The lower edge of +Y and the upper edge of -Y
// adjoin +Z.
using CubeMap = std::array<Image<glm::vec3>, 6>;

// The light from a direction of any length but zero, interpolated between four texels, also across edges.
[[nodiscard]] glm::vec3 cube_light(const CubeMap& cube, const glm::vec3& direction);

// A picture in latitude and longitude (pinocchio/environment.h) of the light from all directions, four times
// as wide as a cube's face. Each texel is the mean of 3 x 3 places. `light` is called on many threads.
[[nodiscard]] Image<glm::vec3> lat_long_of(int side, const std::function<glm::vec3(const glm::vec3&)>& light);

// The same for a rotated cube.
[[nodiscard]] Image<glm::vec3> lat_long_of(const CubeMap& cube, const glm::quat& world_from_cube);

}  // namespace pinocchio
