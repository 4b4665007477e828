// Many pictures of one scene, written to arrays: for data sets and simulators.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <variant>

#include "pinocchio/camera.h"
#include "pinocchio/engine.h"
#include "pinocchio/error.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/motion.h"
#include "pinocchio/nodes.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// Writes a picture of `size` pixels from each camera to the arrays: the same values, to the last bit, as
// those of Engine::render. Arrays have cameras.size() * size.x * size.y pixels; nothing is computed for null
// ones. Returns the rays of all pictures. If the CPU draws alone, the tiles of all
// pictures are one queue for all worker threads, and after the first call no picture allocates memory. Phases
// "build" and "render". Call it on the Engine's thread. Errors: those of Engine::resolve. Throws
// OpenGlError and Cancelled. `motion`: for to.motion, one for each camera; empty: motion is 0.
[[nodiscard]] Expected<RayCounts> render_many(Engine& engine, const Scene& scene,
                                              std::span<const Camera> cameras, glm::ivec2 size,
                                              const Settings& settings, const FrameArrays& to,
                                              Progress* progress = nullptr,
                                              std::span<const MotionTo> motion = {});

// A picture of a pose of the scene.
struct PosedPicture {
  // The nodes that are elsewhere than in the given scene. The span must outlive the call.
  std::span<const NodeTransform> pose{};
  std::variant<Camera, std::size_t>
      camera{};  // or the index of one of the scene's, which moves with its node
};

// The same for a pose each: the values are those of Engine::render for posed(scene, pose). While a pose is
// drawn, the next one is made with its trees on another thread. Neighbouring pictures with the same span are
// one pose. to.motion leads to the next picture; that of the last picture is 0. Errors: also those of
// posed().
[[nodiscard]] Expected<RayCounts> render_many(Engine& engine, const Scene& scene,
                                              std::span<const PosedPicture> pictures, glm::ivec2 size,
                                              const Settings& settings, const FrameArrays& to,
                                              Progress* progress = nullptr);

}  // namespace pinocchio
