#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace pinocchio {

struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0, indirect = 0;

  RayCounts& operator+=(const RayCounts& o);
};

// The kinds of rays, as figures name them.
struct RayKind {
  std::string_view name;
  std::uint64_t RayCounts::*count;
};
inline constexpr std::array kRayKinds{
    RayKind{"primary", &RayCounts::primary},       RayKind{"shadow", &RayCounts::shadow},
    RayKind{"reflection", &RayCounts::reflection}, RayKind{"refraction", &RayCounts::refraction},
    RayKind{"indirect", &RayCounts::indirect},
};

inline RayCounts& RayCounts::operator+=(const RayCounts& o) {
  for (const RayKind& kind : kRayKinds) this->*kind.count += o.*kind.count;
  return *this;
}

}  // namespace pinocchio
