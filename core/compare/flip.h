// FLIP: how much two pictures seem to differ to a person who flips between them.
#pragma once

#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "pinocchio/image.h"

namespace pinocchio {

inline constexpr float kFlipPixelsPerDegree = 67.0f;  // 0.7 m before a screen 0.7 m and 3840 pixels wide
inline constexpr float kLeastPixelsPerDegree = 1.0f, kMostPixelsPerDegree = 1000.0f;

// LDR-FLIP of Andersson et al. 2020, every pixel's error in [0, 1]; symmetric in a and b.
// a, b: the same size, linear Rec. 709, no NaN. They are clamped to [0, 1] first: what an sRGB screen
// shows, as FLIP decodes sRGB itself. pixels_per_degree: of visual angle, in the range above.
[[nodiscard]] Image<float> flip(const Image<glm::vec3>& a, const Image<glm::vec3>& b, float pixels_per_degree,
                                Workers& workers);

// Of all pixels' errors, as one figure; 0 where there are none.
[[nodiscard]] double mean(const Image<float>& errors);

}  // namespace pinocchio
