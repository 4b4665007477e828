// Measures configurations: their time beside raster-only's, their error beside the reference.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/chart/ground_truth.h"
#include "bench/chart/results.h"
#include "bench/chart/sweep.h"
#include "bench/chart/timed_renderer.h"

namespace pinocchio::chart {

// What a chart calls time.
enum class Clock {
  frame,  // from frame to frame, as a person waits
  cpu,    // the processor's, of all threads: hardly changed by other programs; blind to what overlaps
};

// How a chart is measured.
struct BenchSettings {
  int rounds = 5;        // of frames, raster-only's and the configuration's by turns
  int error_frames = 3;  // whose pictures are compared, spread over the frames that count
  int area_side = 6;     // the area reference has the square of it samples a pixel
  Clock clock = Clock::frame;
  Progress* progress = nullptr;  // looked at
};

class Bench {
 public:
  // base: the default configuration's request, but for the view. views: more than kWarmUpFrames +
  // error_frames. folder: pictures go to its "pictures".
  Bench(Engine& engine, FrameRequest base, const BenchSettings& settings, std::vector<View> views,
        std::filesystem::path folder);

  // The figures, and in the folder pictures/NAME.png with its FLIP heat map pictures/NAME-flip.png of the
  // last frame compared.
  [[nodiscard]] PointFigures measure(const Configuration& configuration);

 private:
  [[nodiscard]] FrameRequest request_for(const Settings& settings);
  void measure_time(const FrameRequest& request, PointFigures& figures);
  void measure_error(const Configuration& configuration, const FrameRequest& request, PointFigures& figures);
  [[nodiscard]] std::vector<std::size_t> compared_frames(bool area) const;
  void write_pictures(const std::string& name, const Image<glm::vec4>& color, const PictureError& error,
                      const Image<glm::vec3>& truth, bool area) const;

  Engine& engine_;
  FrameRequest last_;  // of the configuration measured last
  BenchSettings settings_;
  std::vector<View> views_;
  std::filesystem::path folder_;
  GroundTruth ground_truth_;
  TimedRenderer raster_;
  bool warm_ = false;
};

}  // namespace pinocchio::chart
