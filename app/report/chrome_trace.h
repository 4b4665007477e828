#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// The run in Chrome's trace event format (chrome://tracing, Perfetto): a track for the exchange, the tracer
// and the GPU each, more where stages overlap, an arrow from a frame's readback to its trace, upload and
// composite. Microseconds from the first frame's begin.
[[nodiscard]] nlohmann::json chrome_trace(const std::vector<FrameRecord>& records);

}  // namespace pinocchio::app
