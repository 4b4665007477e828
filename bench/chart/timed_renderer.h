#pragma once

#include <vector>

#include "hybrid/schedule.h"
#include "pinocchio/engine.h"

namespace pinocchio::chart {

// Frames of a round that are drawn and not counted: buffers and shaders are made, the first pictures are
// on their way.
inline constexpr std::size_t kWarmUpFrames = kFramesInFlight;

// Draws rounds of frames along a camera's motion, whose pictures stay where they are drawn, and
// takes their times.
class TimedRenderer {
 public:
  struct Round {
    double frame_ms = 0.0;  // from a frame's begin to the next one's, mean of those that count
    double least_ms = 0.0;  // the same of the fastest kFramesInFlight in a row (the fewer there are, of all)
    double cpu_ms = 0.0;    // processor time a frame, of all threads, warming up included
    double latency_ms = 0.0;  // camera sampled to picture delivered, median
    int latency_frames = 0, age_frames = 0;
    double bytes_to_cpu = 0.0, bytes_to_gpu = 0.0;  // of a usual frame
  };

  // request: all but the view. `progress` is looked at.
  TimedRenderer(Engine& engine, FrameRequest request, Progress* progress);

  // views: more than kWarmUpFrames + 1.
  Round draw(const std::vector<View>& views);

 private:
  FrameRequest request_;
  std::vector<FrameRecord> records_;  // of the round, one a sample
  Renderer renderer_;
};

}  // namespace pinocchio::chart
