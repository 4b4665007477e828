#pragma once

#include <pinocchio/frame.h>

#include <optional>
#include <vector>

namespace pinocchio::python {

// A finished picture. Arrays that are computed from it are made at first use, with the GIL held.
struct Result {
  FrameResult frame;  // never changed: calls without the GIL read it
  double ms = 0.0;    // from the call to the picture
  std::optional<SurfaceImages> surfaces{};
  std::vector<std::uint64_t> mask{};  // of pixel_type()
  Image<std::uint32_t> objects{}, materials{}, primitives{};
  Image<glm::vec3> no_reflection{};  // zeros, where the frame traced none
};

}  // namespace pinocchio::python
