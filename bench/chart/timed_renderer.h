#pragma once

#include <vector>

#include "hybrid/frame/schedule.h"
#include "pinocchio/engine.h"

namespace pinocchio::chart {

// Frames of a round that are drawn but not measured: they make buffers and shaders and fill the
// pipeline.
inline constexpr std::size_t kWarmUpFrames = kFramesInFlight;

// Draws rounds of frames along a camera's motion and measures their times. The pictures are not
// read back.
class TimedRenderer {
 public:
  struct Round {
    double frame_ms = 0.0;    // from a frame's begin to the next one's, mean of the measured frames
    double least_ms = 0.0;    // the same for the fastest kFramesInFlight consecutive frames
    double cpu_ms = 0.0;      // processor time per frame, of all threads, with the warm-up
    double latency_ms = 0.0;  // from reading the camera to delivering the picture, median
    int latency_frames = 0, age_frames = 0;
    double bytes_to_cpu = 0.0, bytes_to_gpu = 0.0;  // of a typical frame
  };

  // request: everything but the view. `progress` is checked for cancellation.
  TimedRenderer(Engine& engine, FrameRequest request, Progress* progress);

  // views: more than kWarmUpFrames + 1.
  Round draw(const std::vector<View>& views);

 private:
  FrameRequest request_;
  std::vector<FrameRecord> records_;  // of the round, one for each sample
  Renderer renderer_;
};

}  // namespace pinocchio::chart
