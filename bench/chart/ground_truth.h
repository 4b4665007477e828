// The reference pictures that others are compared with.
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
  std::size_t not_finite = 0;  // pixels with NaN or infinity; if there are any, the other figures are 0
};

// References (core/reference) of frames of a motion. They are drawn at first use and kept as
// reference-centre-FRAME.exr or reference-area-FRAME.exr for a run that continues.
class GroundTruth {
 public:
  // depth: most bounces. area_side: the area reference is the mean of area_side x area_side samples, evenly
  // spread over the pixel. folder: it holds no references of another run.
  GroundTruth(Scene scene, int depth, int area_side, const std::vector<View>& views,
              std::filesystem::path folder, Workers& workers, Progress* progress)
      : scene_(std::move(scene)),
        depth_(depth),
        area_side_(area_side),
        views_(views),
        folder_(std::move(folder)),
        workers_(workers),
        progress_(progress) {}

  // The frame in linear RGB: at the pixels' centres, or the pixels' means.
  [[nodiscard]] const Image<glm::vec3>& reference(std::size_t frame, bool area);

  // The error of a picture's RGB against the frame's reference.
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

// Removes references of another run from the folder.
void forget_references(const std::filesystem::path& folder);

}  // namespace pinocchio::chart
