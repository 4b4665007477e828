#include "pinocchio/compare_pictures.h"

#include <algorithm>

#include "core/compare/picture_error.h"
#include "core/math/finite.h"

namespace pinocchio {

Expected<PictureDifference> compare_pictures(const Image<glm::vec3>& picture,
                                             const Image<glm::vec3>& reference, float pixels_per_degree,
                                             int threads, Progress* progress) {
  const auto refused = [](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{{}, 0, what, remedy});
  };
  const auto text = [](glm::ivec2 size) { return std::to_string(size.x) + "x" + std::to_string(size.y); };
  if (picture.size() != reference.size())
    return refused("the picture is " + text(picture.size()) + ", its reference " + text(reference.size()),
                   "only pictures of the same size can be compared");
  if (!(pixels_per_degree >= kLeastPixelsPerDegree && pixels_per_degree <= kMostPixelsPerDegree))
    return refused("pixels_per_degree is " + std::to_string(pixels_per_degree), "it is from 1 to 1000");
  for (const Image<glm::vec3>* image : {&picture, &reference})
    if (!std::ranges::all_of(image->pixels(), is_finite<3>))
      return refused(
          std::string(image == &picture ? "the picture" : "the reference") + " has NaN or infinity in it",
          "no error figure can be given");
  Workers workers(threads);
  PictureError error = picture_error(picture, reference, pixels_per_degree, workers, progress);
  return PictureDifference{error.rgb.rmse,           error.rgb.relative_mse, error.rgb.psnr_db,
                           error.rgb.max_difference, error.mean_flip,        std::move(error.flip)};
}

}  // namespace pinocchio
