#pragma once

#include "pinocchio/settings.h"

namespace pinocchio {

// Frames that may be begun before one is delivered, that one among them.
inline constexpr int kMostLatency = 2, kFramesInFlight = kMostLatency + 1;

// What a frame of some settings goes through. visibility and composite run where the settings say; mask and
// mirrored light are traced on the CPU:
//
//   visibility  composite
//   gpu         gpu        design 1; nothing is traced where nothing is left for the CPU (raster)
//   gpu         cpu        design 2
//   cpu         gpu        design 1 with primary rays
//   cpu         cpu        raytrace: no OpenGL
struct Schedule {
  bool gpu = true;          // some of it runs there
  bool traces = true;       // something is left for the CPU
  int latency = 0;          // frames begun between a camera's sample and its picture, in a stream of frames
  bool reprojects = false;  // shown at once, with an older frame's mask and reflection
};

// The CPU's part fits beside the next frame's raster; where the GPU composites, its answer is uploaded one
// frame later still. The CPU alone has nobody to wait for.
[[nodiscard]] inline Schedule schedule_of(const Settings& s) {
  Schedule schedule;
  schedule.gpu = s.uses_gpu();
  schedule.traces = s.traces();
  if (!schedule.gpu || !schedule.traces) return schedule;
  if (s.exchange == Exchange::pipelined) schedule.latency = s.composite == Processor::gpu ? kMostLatency : 1;
  schedule.reprojects = s.exchange == Exchange::reproject && s.visibility == Processor::gpu;
  return schedule;
}

// In one word, as --mode has it.
[[nodiscard]] inline const char* mode_name(const Settings& s) {
  return !s.uses_gpu() ? "raytrace" : s.traces() ? "hybrid" : "raster";
}

}  // namespace pinocchio
