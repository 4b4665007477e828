// --skip-existing: work that starts again leaves out the frames that it has.
#pragma once

#include "app/output.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// Tells whether the frame's files are there and need not be drawn again: an EXR that can be read to its end,
// whose header and channels are what this request would give it, and, where one is asked for, a preview whose
// text says the same. It asks no clock, because the header describes what the scene's files hold.
[[nodiscard]] bool is_drawn_already(const OutputOptions& options, const FrameRequest& request,
                                    const FrameHeader& frame);

}  // namespace pinocchio::app
