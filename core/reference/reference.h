// The tracer's reference: the same image model (docs/architecture.md) in double precision, watertight, one
// ray after the other, written to be believed by reading. It shares scene and picture types with the
// tracer and no arithmetic. Slow: for pictures that others are measured against.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/parallel/workers.h"
#include "core/reference/reference_tracer.h"
#include "core/trace/view_params.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

struct ReferencePicture {
  Image<std::uint32_t> ids;  // the triangle that each pixel's centre sees, kNoTriangle: none
  MaskImage mask;            // bit i: the casting light in slot i reaches the visible point
  Image<glm::vec3>
      reflection;  // mirrored plus refracted light, and the environment's, linear; empty where there is none
  Image<glm::vec4> color;  // RGBA, linear; A is 1 where something is hit
};

// An environment lights by 256 samples a point, as a light with a size does. Draws view.box(), `depth`
// bounces at most. The scene has no more casting lights than kMaxCastingLights. Advances `progress` by one
// step.
[[nodiscard]] ReferencePicture reference_render(const Scene& scene, const View& view, int depth,
                                                Workers& workers, Progress* progress = nullptr,
                                                TraceOptions options = {});

}  // namespace pinocchio
