// Many pictures of one scene, straight into arrays: for data sets and simulators.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "pinocchio/camera.h"
#include "pinocchio/engine.h"
#include "pinocchio/error.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// A picture of `size` pixels from each camera, written to the arrays: the same values, to the last bit, as
// those of Engine::render. Of the arrays that are null nothing is computed. Where the CPU draws alone, the
// pictures' tiles are one queue for all worker threads, and once warm no picture allocates anything. Phases
// "build" and "render". From the Engine's thread. Throws NoOpenGlError.
[[nodiscard]] Expected<RayCounts> render_many(Engine& engine, const Scene& scene,
                                              std::span<const Camera> cameras, glm::ivec2 size,
                                              const Settings& settings, const FrameArrays& to,
                                              Progress* progress = nullptr);

}  // namespace pinocchio
