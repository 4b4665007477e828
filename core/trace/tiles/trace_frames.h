// Many pictures of one scene, written to the caller's arrays. Their tiles are one queue, so that small
// pictures keep all threads busy.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "core/parallel/workers.h"
#include "core/trace/tiles/trace_tiles.h"
#include "pinocchio/camera.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/motion.h"
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
  int spp = 1;
  TraceOptions options{};  // of the first sample
  TileOutputs outputs{};   // mask_bits, depth, indirect, environment_light; the rest is set by trace_frames
  PixelFilter filter = PixelFilter::box;
  std::span<const MotionTo> motion{};  // one for each camera; empty: none
  Progress* progress = nullptr;        // advances with each tile; a picture is `spp` steps
};

// The same bits as trace_tiles, surface_images and the mean of the samples give for each picture. Once the
// threads are warm, it allocates a little for each thread and nothing for a picture.
RayCounts trace_frames(const FramesJob& job, const FrameArrays& to);

}  // namespace pinocchio
