// The layers of a finished frame as arrays.
#pragma once

#include <cstddef>

#include "pinocchio/frame.h"
#include "pinocchio/frame_arrays.h"

namespace pinocchio {

// Writes the wanted layers of the frame to the arrays, from place `first` on; where surfaces or motion are
// looked up, on threads of its own. Any thread.
void write_layers(const FrameResult& frame, const FrameArrays& to, std::size_t first = 0);

}  // namespace pinocchio
