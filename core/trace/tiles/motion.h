#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "pinocchio/mesh.h"
#include "pinocchio/motion.h"
#include "pinocchio/view.h"

namespace pinocchio {

// Writes the layer `motion` for the pixels of `tile`, a box of the drawn part: from each pixel's point, on
// the triangle at `ids`, whose lines are `ids_width` apart, to the same point of the triangle in the other
// frame. It goes to place `first` of the array, lines `width` apart. Where neither the pose nor the camera
// has changed, motion is exactly 0.
void write_motion(const Mesh& mesh, const View& view, const MotionTo& other, const PixelBox& tile,
                  const std::uint32_t* ids, std::size_t ids_width, glm::vec2* to, std::size_t first,
                  std::size_t width);

}  // namespace pinocchio
