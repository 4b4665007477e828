// The pictures that others are measured against.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "bench/chart/timed_renderer.h"
#include "core/compare/picture_error.h"
#include "core/parallel/workers.h"

namespace pinocchio::chart {

struct MeasuredError : PictureError {
  std::size_t not_finite = 0;  // pixels with a NaN or infinity; above 0 the other figures are 0
};

// References (core/reference) of some frames of a motion, drawn when they are first asked for.
class GroundTruth {
 public:
  // depth: most bounces. area_side: the area reference is the mean of so many times so many samples, evenly
  // spread over the pixel.
  GroundTruth(const Scene& scene, int depth, int area_side, const std::vector<View>& views, Workers& workers,
              Progress* progress)
      : scene_(scene),
        depth_(depth),
        area_side_(area_side),
        views_(views),
        workers_(workers),
        progress_(progress) {}

  // Linear RGB of the frame: at the pixels' centres, or their means.
  [[nodiscard]] const Image<glm::vec3>& reference(std::size_t frame, bool area);

  // RGB of a picture against the reference of the frame.
  [[nodiscard]] MeasuredError measure(const Image<glm::vec4>& color, std::size_t frame, bool area);

 private:
  const Scene& scene_;
  int depth_, area_side_;
  const std::vector<View>& views_;
  Workers& workers_;
  Progress* progress_;
  std::map<std::pair<std::size_t, bool>, Image<glm::vec3>> references_;
};

}  // namespace pinocchio::chart
