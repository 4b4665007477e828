#include "app/chart/ruler.h"

#include <cmath>
#include <numeric>

#include "app/console.h"
#include "core/compare/flip.h"
#include "hybrid/raytrace.h"

namespace pinocchio::app {
namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Image<glm::vec3> Ruler::drawn(std::size_t frame, glm::vec2 jitter) {
  const View& view = views_[frame];
  Picture picture;
  (void)raytrace({scene_, plan_, view.camera, view.size, view.part, jitter}, workers_, picture);
  Image<glm::vec3> rgb(picture.color.size());
  for (std::size_t i = 0; i < rgb.pixels().size(); ++i) rgb[i] = glm::vec3(picture.color[i]);
  return rgb;
}

const Image<glm::vec3>* Ruler::reference(std::size_t frame, bool area) {
  const auto known = references_.find({frame, area});
  if (known != references_.end()) return &known->second;
  const int side = area ? area_side_ : 1;
  Image<glm::vec3> mean(views_[frame].part.size());
  for (int k = 0; k < side * side; ++k) {
    if (interrupted()) return nullptr;
    const glm::vec2 place(static_cast<float>(k % side), static_cast<float>(k / side));
    const Image<glm::vec3> sample = drawn(frame, (place + 0.5f) / static_cast<float>(side) - 0.5f);
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
      mean[i] += sample[i] / static_cast<float>(side * side);
  }
  return &references_.emplace(std::pair(frame, area), std::move(mean)).first->second;
}

std::optional<PictureError> Ruler::measure(const Image<glm::vec4>& color, std::size_t frame, bool area) {
  const Image<glm::vec3>* const truth = reference(frame, area);
  if (!truth) return std::nullopt;
  Image<glm::vec3> rgb(color.size());
  PictureError error;
  for (std::size_t i = 0; i < rgb.pixels().size(); ++i) {
    rgb[i] = glm::vec3(color[i]);
    if (!is_finite(rgb[i])) ++error.not_finite;
  }
  if (error.not_finite > 0) return error;
  error.rgb = error_figures(rgb.pixels(), truth->pixels());
  error.flip = flip(rgb, *truth, kFlipPixelsPerDegree, workers_);
  const auto errors = error.flip.pixels();
  error.mean_flip = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  return error;
}

Image<glm::vec4> opaque(const Image<glm::vec3>& rgb) {
  Image<glm::vec4> color(rgb.size());
  for (std::size_t i = 0; i < rgb.pixels().size(); ++i) color[i] = glm::vec4(rgb[i], 1.0f);
  return color;
}

}  // namespace pinocchio::app
