#pragma once

#include "pinocchio/names.h"

namespace pinocchio {

// The method that tests whether a ray meets a triangle (core/trace/walk/).
enum class TriangleTest {
  projected,         // Wald 2004, revised 2005: projected along an axis, weights computed in the plane
  moeller_trumbore,  // Möller and Trumbore 1997: weights by cross products of the corners
  watertight,        // Woop, Benthin and Wald 2013: signs of edge functions in the ray's own frame
  filtered,          // projected, with an error bound; doubtful cases are decided in double precision
};

inline constexpr std::array kTriangleTests{TriangleTest::projected, TriangleTest::moeller_trumbore,
                                           TriangleTest::watertight, TriangleTest::filtered};

inline constexpr std::array<std::string_view, 4> kTriangleTestNames{"projected", "moeller-trumbore",
                                                                    "watertight", "filtered"};
[[nodiscard]] constexpr std::string_view triangle_test_name(TriangleTest test) {
  return name_of(kTriangleTestNames, test);
}

}  // namespace pinocchio
