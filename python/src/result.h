#pragma once

#include <pinocchio/frame.h>

#include <optional>

namespace pinocchio::python {

// A finished picture; what is made of it is made when it is first asked for.
struct Result {
  FrameResult frame;
  double ms = 0.0;  // from the call to the picture
  std::optional<SurfaceImages> surfaces{};
  Image<std::uint8_t> mask{};
  Image<std::uint32_t> objects{};
};

}  // namespace pinocchio::python
