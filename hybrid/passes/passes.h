// The steps of a frame, one function each, in the order of renderer.cpp. Only take_on_cpu waits for the GPU.
#pragma once

#include "hybrid/engine/engine_parts.h"
#include "hybrid/engine/frame_slot.h"
#include "hybrid/frame/gathering.h"

namespace pinocchio {

// GPU: draws the ids, and the other channels that travel to the CPU.
void rasterise(GpuPasses& gpu, FrameSlot& frame);
// Starts the readback.
void send_to_cpu(FrameSlot& frame);
// Decodes the channels on the CPU, and opens the buffers for the answer.
void take_on_cpu(FrameSlot& frame);
// Starts the upload.
void send_to_gpu(FrameSlot& frame);
// GPU: draws the picture. `older`: the frame whose mask and reflection are warped to this one; null: its own.
void composite_on_gpu(GpuPasses& gpu, FrameSlot& frame, const FrameSlot* older);

// The CPU's part, on any thread: the tile pass (core/trace/tiles/trace_tiles.h) makes ids, mask, mirrored
// light and picture as the settings need them, filtered with the stream's former samples; encode_answer
// writes the channels to their open buffers.
void trace(Workers& workers, FrameSlot& frame, Gathering& gathering);
void encode_answer(Workers& workers, FrameSlot& frame);

// Repeats each sample for scale x scale pixels.
[[nodiscard]] MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size);
[[nodiscard]] Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size);

}  // namespace pinocchio
