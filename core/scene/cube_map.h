#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pinocchio/image.h"

namespace pinocchio {

// Faces towards +X, -X, +Y, -Y, +Z and -Z, square and of one size: what is seen from the cube's middle, as
// glTF's EXT_lights_image_based has it. Those around have +Y up; the lower edge of +Y and the upper one of -Y
// adjoin +Z.
using CubeMap = std::array<Image<glm::vec3>, 6>;

// What comes from there, of any length but zero; between four texels interpolated, across edges too.
[[nodiscard]] glm::vec3 cube_light(const CubeMap& cube, const glm::vec3& direction);

// A picture in latitude and longitude (pinocchio/environment.h) of what comes from each direction, four times
// as wide as a cube's face: each texel a mean of 3 x 3 places. Any thread may ask for light.
[[nodiscard]] Image<glm::vec3> lat_long_of(int side, const std::function<glm::vec3(const glm::vec3&)>& light);

// The same of a cube that is turned.
[[nodiscard]] Image<glm::vec3> lat_long_of(const CubeMap& cube, const glm::quat& world_from_cube);

}  // namespace pinocchio
