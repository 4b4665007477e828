// Shared by the lanes_NAME.h whose masks are registers as wide as their numbers. Each includes this file with
// the name of its namespace in PINOCCHIO_LANES.
#pragma once

#include <array>
#include <cstdint>

#include "core/simd/isas.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeInt [[gnu::vector_size(4 * kWidth), gnu::may_alias]] = std::uint32_t;
using NativeSigned [[gnu::vector_size(4 * kWidth), gnu::may_alias]] = std::int32_t;
using NativeMask = NativeSigned;

// By mask: which lanes come first, in units of a lane's n-th part (1: lanes, 4: bytes).
template <unsigned kParts>
constexpr auto kPackOrder = [] {
  std::array<std::array<std::uint8_t, kParts * kWidth>, 1u << kWidth> order{};
  for (unsigned mask = 0; mask < order.size(); ++mask) {
    unsigned to = 0;
    for (unsigned lane = 0; lane < kWidth; ++lane)
      if (mask >> lane & 1u)
        for (unsigned part = 0; part < kParts; ++part)
          order[mask][to++] = static_cast<std::uint8_t>(kParts * lane + part);
  }
  return order;
}();

struct VectorLanes {
  using Floats [[gnu::vector_size(4 * kWidth), gnu::may_alias]] = float;
  static NativeMask less(Floats a, Floats b) { return NativeMask(a < b); }
  static NativeMask less_equal(Floats a, Floats b) { return NativeMask(a <= b); }
  static NativeMask equal(Floats a, Floats b) { return NativeMask(a == b); }
  static NativeMask less(NativeSigned a, NativeSigned b) { return a < b; }
  static NativeMask equal(NativeSigned a, NativeSigned b) { return a == b; }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
