#pragma once

#include <glm/glm.hpp>

#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// The difference between a picture and its reference, in figures and as a person perceives it.
struct PictureDifference {
  double rmse = 0.0, relative_mse = 0.0;  // relative: mean of (a - b)^2 / (b^2 + 0.01)
  double psnr_db = 0.0;                   // of the values clamped to [0, 1], peak 1; +inf if they are equal
  double max = 0.0;                       // largest |a - b|
  double flip = 0.0;                      // mean LDR-FLIP
  Image<float> flip_errors;               // of each pixel, in [0, 1]
};

// Linear RGB pictures of the same size, finite. pixels_per_degree: of visual angle, 1 to 1000.
// `threads` 0: one for each core. Errors: different sizes, a value that is not finite. Any thread.
[[nodiscard]] Expected<PictureDifference> compare_pictures(const Image<glm::vec3>& picture,
                                                           const Image<glm::vec3>& reference,
                                                           float pixels_per_degree = 67.0f, int threads = 0,
                                                           Progress* progress = nullptr);

}  // namespace pinocchio
