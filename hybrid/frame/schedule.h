#pragma once

#include "pinocchio/settings.h"

namespace pinocchio {

// The most frames begun between a frame's begin and its delivery, and the most in flight with it.
inline constexpr int kMostLatency = 2, kFramesInFlight = kMostLatency + 1;

// The parts of a frame. visibility and composite run where the settings say; mask and mirrored light are
// traced on the CPU:
//
//   visibility  composite
//   gpu         gpu        design 1; without mask and mirrored light nothing is traced (raster)
//   gpu         cpu        design 2
//   cpu         gpu        design 1 with primary rays
//   cpu         cpu        raytrace: no OpenGL
struct Schedule {
  bool gpu = true;          // some part runs on the GPU
  bool traces = true;       // some part runs on the CPU
  int latency = 0;          // frames begun between a camera's sample and its picture, in a stream of frames
  bool reprojects = false;  // shown at once, with an older frame's mask and reflection
};

// The CPU's part runs beside the next frame's raster; where the GPU composites, the answer is uploaded
// another frame later. The CPU alone waits for nothing.
[[nodiscard]] inline Schedule schedule_of(const Settings& s) {
  Schedule schedule;
  schedule.gpu = s.uses_gpu();
  schedule.traces = s.traces();
  if (!schedule.gpu || !schedule.traces) return schedule;
  if (s.exchange == Exchange::pipelined) schedule.latency = s.composite == Processor::gpu ? kMostLatency : 1;
  schedule.reprojects = s.exchange == Exchange::reproject && s.visibility == Processor::gpu;
  return schedule;
}

// The word for it that --mode takes.
[[nodiscard]] inline const char* mode_name(const Settings& s) {
  return !s.uses_gpu() ? "raytrace" : s.traces() ? "hybrid" : "raster";
}

}  // namespace pinocchio
