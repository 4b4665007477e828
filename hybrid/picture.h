#pragma once

#include <cstdint>

#include "core/image/image.h"
#include "core/trace/mask_image.h"
#include "hybrid/plan.h"

namespace pinocchio {

// A finished picture with what it was made of.
struct Picture {
  Image<glm::vec4> color;  // linear RGBA, mean of the samples
  // Of the first sample, at the pixels' centres:
  Image<std::uint32_t> ids;     // kNoTriangle where nothing is seen
  MaskImage mask;               // 0 bits where the plan has none, or the frame's own is not traced yet
  Image<glm::vec3> reflection;  // empty, likewise
  Plan plan;                    // that it was drawn by
  std::size_t holes = 0;        // reprojected: pixels that no older frame had an answer for
};

}  // namespace pinocchio
