// Many pictures of one scene, written to arrays: for data sets and simulators.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "pinocchio/camera.h"
#include "pinocchio/engine.h"
#include "pinocchio/error.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/motion.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// Writes a picture of `size` pixels from each camera to the arrays: the same values, to the last bit, as
// those of Engine::render. Nothing is computed for null arrays. If the CPU draws alone, the tiles of all
// pictures are one queue for all worker threads, and after the first call no picture allocates memory. Phases
// "build" and "render". Call it on the Engine's thread. Throws NoOpenGlError. `motion`: for to.motion, one
// for each camera; empty: motion is 0.
[[nodiscard]] Expected<RayCounts> render_many(Engine& engine, const Scene& scene,
                                              std::span<const Camera> cameras, glm::ivec2 size,
                                              const Settings& settings, const FrameArrays& to,
                                              Progress* progress = nullptr,
                                              std::span<const MotionTo> motion = {});

}  // namespace pinocchio
