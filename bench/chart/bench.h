// Measures configurations: their time relative to raster-only's, their error against the reference.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/chart/ground_truth.h"
#include "bench/chart/results.h"
#include "bench/chart/sweep.h"
#include "bench/chart/timed_renderer.h"

namespace pinocchio::chart {

// The time that a chart measures.
enum class Clock {
  frame,  // wall clock, from frame to frame
  cpu,    // processor time of all threads: hardly affected by other programs, and by overlap not at all
};

// The parameters of a measurement.
struct BenchSettings {
  int rounds = 5;        // of frames, raster-only's and the configuration's interleaved
  int error_frames = 3;  // compared frames, spread over the measured ones
  int area_side = 6;     // the area reference has its square of samples for each pixel
  Clock clock = Clock::frame;
  Progress* progress = nullptr;  // checked for cancellation
};

class Bench {
 public:
  // base: the default configuration's request without the view. views: more than kWarmUpFrames +
  // error_frames. folder: pictures are written to its "pictures".
  Bench(Engine& engine, FrameRequest base, const BenchSettings& settings, std::vector<View> views,
        std::filesystem::path folder);

  // Returns the figures, and writes pictures/NAME.png and its FLIP heat map pictures/NAME-flip.png for the
  // last compared frame.
  [[nodiscard]] PointFigures measure(const Configuration& configuration);

 private:
  [[nodiscard]] FrameRequest request_for(const Settings& settings);
  void measure_time(const FrameRequest& request, PointFigures& figures);
  void measure_error(const Configuration& configuration, const FrameRequest& request, PointFigures& figures);
  [[nodiscard]] std::vector<std::size_t> compared_frames(bool area) const;
  void write_pictures(const std::string& name, const Image<glm::vec4>& color, const PictureError& error,
                      const Image<glm::vec3>& truth, bool area) const;

  Engine& engine_;
  FrameRequest last_;  // of the configuration that was measured last
  BenchSettings settings_;
  std::vector<View> views_;
  std::filesystem::path folder_;
  GroundTruth ground_truth_;
  TimedRenderer raster_;
  bool warm_ = false;
};

}  // namespace pinocchio::chart
