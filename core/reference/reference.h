// The reference that the tracer is checked against: the same image model (docs/architecture.md) in double
// precision, watertight, one ray at a time, in code that is simple to read. It shares scene and picture types
// with the tracer, but no arithmetic. It is slow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "core/reference/reference_tracer.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

struct ReferencePicture {
  Image<std::uint32_t> ids;  // the triangle at each pixel's centre; kNoTriangle: none
  MaskImage mask;            // bit i: the casting light in slot i reaches the visible point
  Image<glm::vec3>
      reflection;  // mirrored, refracted and the environment's light, linear; empty: the scene has none
  Image<glm::vec4> color;  // RGBA, linear; A is 1 where something is hit
};

// Draws view.box() with at most `depth` bounces. An environment and each light with a size take 256 samples
// for each point. Advances `progress` by one step.
[[nodiscard]] ReferencePicture reference_render(const Scene& scene, const View& view, int depth,
                                                Workers& workers, Progress* progress = nullptr,
                                                TraceOptions options = {});

}  // namespace pinocchio
