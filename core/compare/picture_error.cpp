#include "core/compare/picture_error.h"

namespace pinocchio {

PictureError picture_error(const Image<glm::vec3>& picture, const Image<glm::vec3>& reference,
                           float pixels_per_degree, Workers& workers, Progress* progress) {
  PictureError error;
  error.rgb = error_figures(picture.pixels(), reference.pixels());
  error.flip = flip(picture, reference, pixels_per_degree, workers, progress);
  error.mean_flip = mean(error.flip);
  return error;
}

}  // namespace pinocchio
