// Luminances of 8 bits that choose among directions: 5 bits of exponent and 3 of mantissa. In units of the
// picture's brightest, rounded up, and never zero, so that no light is left out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace pinocchio {

// The number's bits, as those of a float, are this and the 8 bits from bit kBrightnessShift up.
inline constexpr unsigned kBrightnessShift = 20;
inline constexpr std::uint32_t kLeastBrightness = 96u << 23;  // 2^-31: 1 has the largest exponent

// share: 0 to 1.
[[nodiscard]] inline std::uint32_t packed_brightness(float share) {
  std::uint32_t bits;
  std::memcpy(&bits, &share, sizeof(bits));
  if (bits <= kLeastBrightness) return 0;
  return (bits - kLeastBrightness + (1u << kBrightnessShift) - 1u) >> kBrightnessShift;
}

}  // namespace pinocchio
