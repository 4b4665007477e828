// The tracer's reference: the same image model (docs/architecture.md) in double precision, watertight, one
// ray after the other, written to be believed by reading. It shares scene and picture types with the
// tracer and no arithmetic. Slow: for pictures that others are measured against.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/image/image.h"
#include "core/parallel/workers.h"
#include "core/reference/reference_tracer.h"
#include "core/scene/scene.h"
#include "core/trace/mask_image.h"
#include "core/trace/shared.h"

namespace pinocchio {

// Draws a whole picture of ids' size; the other images are resized to it.
//   ids: the triangle that each pixel's centre sees, kNoTriangle: none
//   mask: bit i, the casting light in slot i reaches the visible point; as few bits as hold the scene's
//     casting lights, which are at most kMaxCastingLights
//   reflection: mirrored plus refracted light, linear, `depth` bounces at most; empty with depth 0
//   color: RGBA, linear; A is 1 where something is hit
void reference_picture(const Scene& scene, Workers& workers, const shared::ViewParams& view, int depth,
                       Image<std::uint32_t>& ids, MaskImage& mask, Image<glm::vec3>& reflection,
                       Image<glm::vec4>& color);

}  // namespace pinocchio
