#pragma once

#include <optional>

#include "pinocchio/bounds.h"
#include "pinocchio/camera.h"
#include "pinocchio/tracer.h"

namespace pinocchio::app {

// What matters of a scene: all of it but the triangles that lie in its box's faces (walls, the ground), where
// anything else is left.
[[nodiscard]] Bounds bounds_of_interest(const Mesh& mesh);

// The camera, in front of the first wall between it and the box that it looks at.
[[nodiscard]] Camera before_walls(Camera camera, const Bounds& seen, const Tracer& tracer);

// The surface that the pixel shows; nothing: there is none. screen: pixels.
[[nodiscard]] std::optional<glm::vec3> surface_under(glm::vec2 pixel, glm::vec2 screen, const Camera& camera,
                                                     const Tracer& tracer);

}  // namespace pinocchio::app
