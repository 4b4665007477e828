#include "hybrid/reference_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/compare/figures.h"
#include "core/compare/flip.h"
#include "core/compare/magma.h"

namespace pinocchio {
namespace {

Image<glm::vec3> rgb_of(const Image<glm::vec4>& picture) {
  Image<glm::vec3> rgb(picture.size());
  const auto finite_or_black = [](float c) { return std::isfinite(c) ? c : 0.0f; };
  for (std::size_t i = 0; i < rgb.pixels().size(); ++i)
    for (int c = 0; c < 3; ++c) rgb[i][c] = finite_or_black(picture[i][c]);
  return rgb;
}

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
  const Image<glm::vec3> a = rgb_of(picture), b = rgb_of(reference);
  const Image<float> flipped = flip(a, b, kFlipPixelsPerDegree, workers);
  const auto values = flipped.pixels();
  ReferenceError error;
  error.rmse = error_figures(a.pixels(), b.pixels()).rmse;
  error.mean_flip = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  error.heat = magma(map == ErrorMap::flip ? flipped : largest_differences(a, b));
  return error;
}

}  // namespace pinocchio
