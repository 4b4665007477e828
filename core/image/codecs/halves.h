#pragma once

#include <cstdint>
#include <span>

namespace pinocchio {

// Rounds to 16-bit floats (the bits of Imath's half); finite values beyond 65504 become 65504.
void to_halves(std::span<const float> values, std::uint16_t* to);

}  // namespace pinocchio
