#pragma once

#include <array>
#include <string_view>

#include "pinocchio/names.h"

namespace pinocchio {

// What is done where a coarse mesh's shading normals face a light and its facets do not (the shadow
// terminator).
enum class Terminator {
  off,          // such points are dark
  smoothed,     // light falls smoothly to zero where the facet turns away (Chiang, Li and Burley 2019)
  displaced,    // shadow rays start on the curved surface that the vertex normals mean (Hanika 2021)
  turned_away,  // the same for facets that turn away alone, where the way up to the curved surface is free
};

inline constexpr std::array kTerminators{Terminator::off, Terminator::smoothed, Terminator::displaced,
                                         Terminator::turned_away};
inline constexpr std::array<std::string_view, 4> kTerminatorNames{"off", "smoothed", "displaced",
                                                                  "turned-away"};
[[nodiscard]] constexpr std::string_view terminator_name(Terminator method) {
  return name_of(kTerminatorNames, method);
}
// Whether points may be lifted off their facets.
[[nodiscard]] constexpr bool lifts(Terminator method) {
  return method == Terminator::displaced || method == Terminator::turned_away;
}

inline constexpr Terminator kUsualTerminator = Terminator::turned_away;

}  // namespace pinocchio
