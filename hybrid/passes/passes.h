// What is done to a frame, one function a step; the order is renderer.cpp's. None waits for the GPU but
// take_on_cpu.
#pragma once

#include "hybrid/engine_parts.h"
#include "hybrid/frame_slot.h"

namespace pinocchio {

// GPU: what each pixel sees, and what of it travels.
void rasterise(GpuPasses& gpu, FrameSlot& frame);
// Exchange: sets out for the CPU; is taken there, and the buffers opened that the answer will travel in; sets
// out for the GPU.
void send_to_cpu(FrameSlot& frame);
void take_on_cpu(FrameSlot& frame);
void send_to_gpu(FrameSlot& frame);
// GPU: the picture. `older`: the frame whose mask and reflection are warped to this one, else its own.
void composite_on_gpu(GpuPasses& gpu, FrameSlot& frame, const FrameSlot* older);

// The CPU's part, on any thread: the tile pass (core/trace/trace_tiles.h) gives what the settings ask for of
// ids, mask, mirrored light and the picture; what travels is written into the buffers that are open for it.
void trace(Workers& workers, FrameSlot& frame);
void encode_answer(Workers& workers, FrameSlot& frame);

// A picture at one sample for scale x scale pixels, at every pixel.
[[nodiscard]] MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size);
[[nodiscard]] Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size);

}  // namespace pinocchio
