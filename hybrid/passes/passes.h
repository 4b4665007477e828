// What is done to a frame, one function a step; the order is renderer.cpp's. None waits for the GPU but
// take_on_cpu.
#pragma once

#include <array>
#include <string_view>

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

// What the CPU's passes work with.
struct CpuTools {
  Engine::Parts& engine;
  Workers& workers;
};
void trace_visibility(const CpuTools& cpu, FrameSlot& frame);  // camera rays
void trace_shadows(const CpuTools& cpu, FrameSlot& frame);     // the mask
void trace_mirrors(const CpuTools& cpu, FrameSlot& frame);     // mirrored and refracted light
void composite_on_cpu(const CpuTools& cpu, FrameSlot& frame);  // their sum with Phong
void encode_answer(const CpuTools& cpu, FrameSlot& frame);     // into the buffers that travel

// The CPU's part of a frame, on any thread: those passes, in this order, that the settings ask for.
struct CpuPass {
  bool (*wanted)(const Settings&);
  void (*run)(const CpuTools&, FrameSlot&);
};
inline constexpr std::array kCpuPasses{
    CpuPass{[](const Settings& s) { return s.visibility == Processor::cpu; }, trace_visibility},
    CpuPass{[](const Settings& s) { return s.mask_bits > 0; }, trace_shadows},
    CpuPass{[](const Settings& s) { return s.reflects(); }, trace_mirrors},
    CpuPass{[](const Settings& s) { return s.composite == Processor::cpu; }, composite_on_cpu},
    CpuPass{[](const Settings& s) { return s.composite == Processor::gpu; }, encode_answer},
};

// A picture at one sample for scale x scale pixels, at every pixel.
[[nodiscard]] MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size);
[[nodiscard]] Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size);

}  // namespace pinocchio
