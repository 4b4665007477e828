#pragma once

#include "core/trace/passes.h"
#include "hybrid/flight.h"

namespace pinocchio {

// The rays of the request's picture, as its plan has them fired; one for scale x scale pixels.
[[nodiscard]] TraceJob trace_job(const FrameRequest& request, const shared::ViewParams& view,
                                 Workers& workers, int scale = 1);

// The CPU's part of a frame: shadow mask and reflection of what the pixels see, as the plan asks for them.
// ids: every pixel's; mask and reflection are of as many samples as the plan has. Notes times and rays.
void trace_answer(const FrameRequest& request, const shared::ViewParams& view, Workers& workers,
                  const Image<std::uint32_t>& ids, MaskImage& mask, Image<glm::vec3>& reflection,
                  FrameRecord& record);

// The same at every pixel, from one sample for scale x scale: for people and files.
[[nodiscard]] MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size);
[[nodiscard]] Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size);

}  // namespace pinocchio
