// --skip-existing: a run that is started again skips frames that exist.
#pragma once

#include "app/run/output.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// Whether the frame's files need not be drawn again: the EXR can be read to its end, it has the header and
// channels of this request, and the preview, where one is written, has the same text. Times of files do not
// count: the header describes the content of the scene's files.
[[nodiscard]] bool is_drawn_already(const OutputOptions& options, const FrameRequest& request,
                                    const FrameHeader& frame);

}  // namespace pinocchio::app
