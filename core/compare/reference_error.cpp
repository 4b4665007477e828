#include "core/compare/reference_error.h"

#include <algorithm>
#include <cassert>

#include "core/compare/magma.h"
#include "core/compare/picture_error.h"
#include "core/image/rgb.h"

namespace pinocchio {
namespace {

Image<float> largest_differences(const Image<glm::vec3>& a, const Image<glm::vec3>& b) {
  Image<float> result(a.size());
  for (std::size_t i = 0; i < result.pixels().size(); ++i) {
    const glm::vec3 d = glm::abs(a[i] - b[i]);
    result[i] = std::max({d.x, d.y, d.z});
  }
  return result;
}

}  // namespace

ReferenceError error_against(const Image<glm::vec4>& picture, const Image<glm::vec4>& reference, ErrorMap map,
                             Workers& workers) {
  assert(picture.size() == reference.size() && !picture.empty());
  const Image<glm::vec3> a = finite_rgb_of(picture), b = finite_rgb_of(reference);
  const PictureError error = picture_error(a, b, kFlipPixelsPerDegree, workers);
  return {magma(map == ErrorMap::flip ? error.flip : largest_differences(a, b)), error.rgb.rmse,
          error.mean_flip};
}

}  // namespace pinocchio
