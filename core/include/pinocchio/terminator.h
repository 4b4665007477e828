#pragma once

#include <array>
#include <string_view>

#include "pinocchio/names.h"

namespace pinocchio {

// The treatment of points where a coarse mesh's shading normals face a light and its facets do not (the
// shadow terminator).
enum class Terminator {
  off,          // these points are dark
  smoothed,     // light falls smoothly to zero where the facet turns away (Chiang, Li and Burley 2019)
  displaced,    // shadow rays start on the curved surface of the vertex normals (Hanika 2021)
  turned_away,  // as displaced, but only on facets that turn away with a free way to the curved surface
};

inline constexpr std::array kTerminators{Terminator::off, Terminator::smoothed, Terminator::displaced,
                                         Terminator::turned_away};
inline constexpr std::array<std::string_view, 4> kTerminatorNames{"off", "smoothed", "displaced",
                                                                  "turned-away"};
[[nodiscard]] constexpr std::string_view terminator_name(Terminator method) {
  return name_of(kTerminatorNames, method);
}
// Whether shadow rays may start above their facets.
[[nodiscard]] constexpr bool lifts(Terminator method) {
  return method == Terminator::displaced || method == Terminator::turned_away;
}

inline constexpr Terminator kUsualTerminator = Terminator::turned_away;

}  // namespace pinocchio
