#pragma once

#include <cstdint>

#include "pinocchio/scene.h"

namespace pinocchio::chart {

// CRC-32 of everything in a scene that a picture depends on. Scenes with the same checksum count as
// the same.
[[nodiscard]] std::uint32_t checksum_of(const Scene& scene);

}  // namespace pinocchio::chart
