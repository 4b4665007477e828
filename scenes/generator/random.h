#pragma once

#include <cstdint>

namespace pinocchio {

// Numbers that look random and are the same everywhere (PCG, O'Neill 2014), unlike the standard
// library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) { next(); }

  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto turn = static_cast<std::uint32_t>(old >> 59u);
    return mixed >> turn | mixed << ((32u - turn) & 31u);
  }
  // In [lo, hi).
  float between(float lo, float hi) { return lo + (hi - lo) * (static_cast<float>(next() >> 8u) * 0x1p-24f); }

 private:
  std::uint64_t state_;
};

}  // namespace pinocchio
