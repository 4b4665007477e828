#pragma once

#include <array>
#include <string_view>

#include "pinocchio/material.h"
#include "pinocchio/names.h"

namespace pinocchio {

// Which triangles the camera's rays pass where they meet the back. A triangle's front is the side from which
// its corners run counterclockwise. Other rays are stopped by both sides.
enum class Backfaces {
  automatic,  // those whose file says that the material is single-sided, as glTF does
  draw,       // none
  cull,       // all whose file does not say that the material is double-sided
};

inline constexpr std::array kBackfaces{Backfaces::automatic, Backfaces::draw, Backfaces::cull};
inline constexpr std::array<std::string_view, 3> kBackfacesNames{"auto", "draw", "cull"};

// Whether the camera's rays pass the backs of triangles with this material.
[[nodiscard]] inline bool passes_backs(const Material& material, Backfaces backfaces) {
  if (backfaces == Backfaces::draw) return false;
  return !material.double_sided.value_or(backfaces == Backfaces::automatic);
}

}  // namespace pinocchio
