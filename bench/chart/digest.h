#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace pinocchio::app {

// A check sum (CRC-32) of everything in a scene that a picture depends on: two scenes with the same digest
// are taken to be one.
[[nodiscard]] std::uint32_t digest_of(const Scene& scene);

}  // namespace pinocchio::app
