// Many pictures of one scene at once: all their tiles in one queue, so that small pictures keep every thread
// busy, and written where the caller wants them.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "core/parallel/workers.h"
#include "core/trace/trace_tiles.h"
#include "pinocchio/camera.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"
#include "pinocchio/view.h"

namespace pinocchio {

struct FramesJob {
  const Scene& scene;  // its mesh is the tracer's
  const Tracer& tracer;
  Workers& workers;
  std::span<const Camera> cameras;
  glm::ivec2 size;
  int spp = 1, depth = 0, indirect = 0, mask_bits = 0;
  bool environment_light = false;
  TraceOptions options{};  // of the first sample
  PixelFilter filter = PixelFilter::box;
  Progress* progress = nullptr;  // told of every tile: a picture is `spp` steps
};

// The bits that trace_tiles, surface_images and the mean of the samples give for each picture alone.
// Allocates a little for each thread and nothing for a picture, once the threads are warm.
RayCounts trace_frames(const FramesJob& job, const FrameArrays& to);

}  // namespace pinocchio
