// The pictures that others are measured against.
#pragma once

#include <filesystem>
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

// References (core/reference) of some frames of a motion, drawn when they are first asked for and kept as
// reference-centre-FRAME.exr or reference-area-FRAME.exr, from which a run that goes on reads them.
class GroundTruth {
 public:
  // depth: most bounces. area_side: the area reference is the mean of so many times so many samples, evenly
  // spread over the pixel. folder: where they are kept; it holds none of another run.
  GroundTruth(Scene scene, int depth, int area_side, const std::vector<View>& views,
              std::filesystem::path folder, Workers& workers, Progress* progress)
      : scene_(std::move(scene)),
        depth_(depth),
        area_side_(area_side),
        views_(views),
        folder_(std::move(folder)),
        workers_(workers),
        progress_(progress) {}

  // Linear RGB of the frame: at the pixels' centres, or their means.
  [[nodiscard]] const Image<glm::vec3>& reference(std::size_t frame, bool area);

  // RGB of a picture against the reference of the frame.
  [[nodiscard]] MeasuredError measure(const Image<glm::vec4>& color, std::size_t frame, bool area);

 private:
  [[nodiscard]] Image<glm::vec3> draw(std::size_t frame, bool area) const;

  Scene scene_;
  int depth_, area_side_;
  const std::vector<View>& views_;
  std::filesystem::path folder_;
  Workers& workers_;
  Progress* progress_;
  std::map<std::pair<std::size_t, bool>, Image<glm::vec3>> references_;
};

// Removes those that another run has left in the folder.
void forget_references(const std::filesystem::path& folder);

}  // namespace pinocchio::chart
