#pragma once

#include <optional>

#include "pinocchio/bounds.h"
#include "pinocchio/camera.h"
#include "pinocchio/tracer.h"

namespace pinocchio::app {

// The bounds of a scene without the triangles in the faces of its box (walls, the ground). Where all
// triangles lie there, the bounds of all.
[[nodiscard]] Bounds bounds_of_interest(const Mesh& mesh);

// The camera, moved in front of the first wall between it and the box that it looks at.
[[nodiscard]] Camera before_walls(Camera camera, const Bounds& seen, const Tracer& tracer);

// The point of the surface that the pixel shows. Nothing: there is no surface. screen: pixels.
[[nodiscard]] std::optional<glm::vec3> surface_under(glm::vec2 pixel, glm::vec2 screen, const Camera& camera,
                                                     const Tracer& tracer, Backfaces backfaces);

}  // namespace pinocchio::app
