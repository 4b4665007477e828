#pragma once

#include <cstdint>

namespace pinocchio {

// A triangle as its three corners, for the tests that need nothing else.
struct CornerTriangle {
  float corners[3][3];  // a, b, c; p_world
  std::uint32_t id;     // index in the scene's triangle order
};

static_assert(sizeof(CornerTriangle) == 40);

}  // namespace pinocchio
