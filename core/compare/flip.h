// FLIP: the difference that a person sees when flipping between two pictures.
#pragma once

#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "pinocchio/image.h"
#include "pinocchio/progress.h"

namespace pinocchio {

inline constexpr float kFlipPixelsPerDegree = 67.0f;  // 0.7 m from a screen 0.7 m and 3840 pixels wide
inline constexpr float kLeastPixelsPerDegree = 1.0f, kMostPixelsPerDegree = 1000.0f;

// LDR-FLIP of Andersson et al. 2020: an error in [0, 1] for each pixel, symmetric in a and b.
// a, b: the same size, linear Rec. 709, without NaN. They are first clamped to [0, 1], the range of an sRGB
// screen. pixels_per_degree: of visual angle, in the range above.
[[nodiscard]] Image<float> flip(const Image<glm::vec3>& a, const Image<glm::vec3>& b, float pixels_per_degree,
                                Workers& workers, Progress* progress = nullptr);

// The mean of all pixels' errors; 0 without pixels.
[[nodiscard]] double mean(const Image<float>& errors);

}  // namespace pinocchio
