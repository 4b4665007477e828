#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace pinocchio {

// A triangle as its three corners, for the tests that need nothing else.
struct CornerTriangle {
  float corners[3][3];  // a, b, c; p_world
  std::uint32_t id;     // index in the scene's triangle order

  static CornerTriangle from(std::span<const glm::vec3> positions, const glm::uvec3& corners,
                             std::uint32_t id) {
    CornerTriangle triangle;
    triangle.id = id;
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) triangle.corners[corner][axis] = positions[corners[corner]][axis];
    return triangle;
  }
};

static_assert(sizeof(CornerTriangle) == 40);

}  // namespace pinocchio
