#pragma once

#include <cstdint>

namespace pinocchio {

struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0, indirect = 0;

  RayCounts& operator+=(const RayCounts& o) {
    primary += o.primary;
    shadow += o.shadow;
    reflection += o.reflection;
    refraction += o.refraction;
    indirect += o.indirect;
    return *this;
  }
};

}  // namespace pinocchio
