// --skip-existing: work that starts again leaves out the frames that it has.
#pragma once

#include "app/output.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// Whether the frame's files are there and need not be drawn again: an EXR that can be read to its end, whose
// header and channels are what this request would give it, and a preview, where one is asked for; neither
// older than the scene's files.
[[nodiscard]] bool is_drawn_already(const OutputOptions& options, const FrameRequest& request,
                                    const FrameHeader& frame);

}  // namespace pinocchio::app
