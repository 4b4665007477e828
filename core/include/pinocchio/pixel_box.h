#pragma once

#include <glm/glm.hpp>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// A half-open box of pixels.
struct PixelBox {
  glm::ivec2 lo{0, 0};
  glm::ivec2 hi{0, 0};

  [[nodiscard]] glm::ivec2 size() const { return hi - lo; }
  [[nodiscard]] bool empty() const { return hi.x <= lo.x || hi.y <= lo.y; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

}  // namespace pinocchio
