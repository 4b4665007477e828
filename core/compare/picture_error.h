#pragma once

#include <glm/glm.hpp>

#include "core/compare/figures.h"
#include "core/compare/flip.h"
#include "core/parallel/workers.h"
#include "pinocchio/image.h"

namespace pinocchio {

// The difference between a picture and its reference, in figures and as a person sees it.
struct PictureError {
  ErrorFigures rgb;
  Image<float> flip;
  double mean_flip = 0.0;
};

// picture, reference: the same size, linear RGB, finite.
[[nodiscard]] PictureError picture_error(const Image<glm::vec3>& picture, const Image<glm::vec3>& reference,
                                         float pixels_per_degree, Workers& workers,
                                         Progress* progress = nullptr);

}  // namespace pinocchio
