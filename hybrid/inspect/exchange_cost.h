#pragma once

#include <glm/glm.hpp>

#include "pinocchio/engine.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// The cost of moving a frame's buffers, with nothing to wait for: median milliseconds. The tracer reads and
// writes the mapped buffers itself; that time is not counted.
struct ExchangeCost {
  double to_cpu_ms = 0.0, to_gpu_ms = 0.0;  // framebuffer to mapped memory; from there to a texture
  double memcpy_to_cpu_ms = 0.0, memcpy_to_gpu_ms = 0.0;  // plain copies of the same bytes
};

// In the engine's OpenGL context. Throws OpenGlError.
[[nodiscard]] ExchangeCost measure_exchange(Engine& engine, const Settings& settings, glm::ivec2 size);

}  // namespace pinocchio
