#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/base/error.h"
#include "hybrid/needs.h"

namespace pinocchio {

// Who draws.
enum class Mode { hybrid, raytrace, raster };

// How the CPU's mirrored and refracted light travels to the GPU.
enum class ReflectionFormat {
  none,
  rgb8,  // 3 bytes a pixel, sRGB, clipped at 1
  half,  // 6 bytes a pixel
};

// What a frame models and what travels between GPU and CPU for it.
struct Plan {
  Mode mode = Mode::hybrid;
  int design = 1;        // where the parts meet: 1, on the GPU; 2, on the CPU
  int id_bits = 32;      // of a triangle id on its way to the CPU: 16, 24 or 32; the highest value is "none"
  bool normals = false;  // design 1: shading normals go to the CPU as well, 3 bytes a pixel
  bool wide = false;  // design 2: the 128-bit buffer of shaders/gbuffer.frag goes to the CPU, not ids alone
  int mask_bits = 0;  // a pixel: 0 (no shadow pass), 1, 2, 4 or 8
  ReflectionFormat reflection = ReflectionFormat::none;  // none: no reflection pass
  int depth = 0;                                         // most bounces
  bool precise = false;                                  // raytrace: drawn by core/reference, in double

  // Whether anything is left for the CPU to do.
  [[nodiscard]] bool traces() const {
    return mask_bits > 0 || reflection != ReflectionFormat::none || (mode == Mode::hybrid && design == 2);
  }
  [[nodiscard]] bool reflects() const { return reflection != ReflectionFormat::none; }
  friend bool operator==(const Plan&, const Plan&) = default;
};

struct PlanRequest {
  Mode mode = Mode::hybrid;
  int design = 1;
  int depth = 8;
  bool slides = false;  // the fixed budget of 2005: design 1 6 bytes a pixel up and 4 down, design 2 19 and 3
  bool precise = false;  // raytrace: by the reference in double; other modes have none and ignore it
};

// The least that draws the scene exactly, or the slides' fixed budget. An error where the scene needs what
// no plan has (more casting lights than mask slots, more triangles than 24-bit ids).
[[nodiscard]] Expected<Plan> make_plan(const Needs& needs, const PlanRequest& request);

// What a hybrid frame of this plan moves, bytes.
struct TrafficBytes {
  std::size_t to_cpu = 0, to_gpu = 0;
};
[[nodiscard]] TrafficBytes traffic_of(const Plan& plan, glm::ivec2 size);

[[nodiscard]] const char* mode_name(Mode mode);
[[nodiscard]] nlohmann::json to_json(const Plan& plan);

}  // namespace pinocchio
