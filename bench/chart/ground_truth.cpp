#include "bench/chart/ground_truth.h"

#include <algorithm>

#include "core/image/rgb.h"
#include "core/math/finite.h"
#include "core/reference/reference.h"

namespace pinocchio::chart {

const Image<glm::vec3>& GroundTruth::reference(std::size_t frame, bool area) {
  const auto known = references_.find({frame, area});
  if (known != references_.end()) return known->second;
  const int side = area ? area_side_ : 1;
  View view = views_[frame];
  Image<glm::vec3> mean(view.box().size());
  for (int k = 0; k < side * side; ++k) {
    const glm::vec2 place(static_cast<float>(k % side), static_cast<float>(k / side));
    view.jitter = (place + 0.5f) / static_cast<float>(side) - 0.5f;
    const Image<glm::vec3> sample = rgb_of(reference_render(scene_, view, depth_, workers_, progress_).color);
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
      mean[i] += sample[i] / static_cast<float>(side * side);
  }
  return references_.emplace(std::pair(frame, area), std::move(mean)).first->second;
}

MeasuredError GroundTruth::measure(const Image<glm::vec4>& color, std::size_t frame, bool area) {
  const Image<glm::vec3>& truth = reference(frame, area);
  const Image<glm::vec3> rgb = rgb_of(color);
  const auto finite = std::ranges::count_if(rgb.pixels(), is_finite);
  const std::size_t not_finite = rgb.pixels().size() - static_cast<std::size_t>(finite);
  if (not_finite > 0) return {{}, not_finite};
  return {picture_error(rgb, truth, kFlipPixelsPerDegree, workers_)};
}

}  // namespace pinocchio::chart
