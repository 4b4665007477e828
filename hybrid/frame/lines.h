#pragma once

#include <cstddef>

#include "pinocchio/frame.h"
#include "pinocchio/frame_arrays.h"

namespace pinocchio {

// Writes the lines [y0, y1) of the wanted layers to the arrays, from place `first` on. Any thread.
void write_lines(const FrameResult& frame, int y0, int y1, const FrameArrays& to, std::size_t first = 0);

// Writes the normals and albedos that the frame's sample sees, where it sees them in the pixels. On all
// threads.
void write_sample_surfaces(const FrameResult& frame, SurfaceImages& to);

}  // namespace pinocchio
