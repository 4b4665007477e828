#pragma once

#include <array>
#include <string_view>

#include "core/base/error.h"
#include "core/trace/scatter.h"
#include "hybrid/needs.h"

namespace pinocchio {

// Who draws.
enum class Mode { hybrid, raytrace, raster };
inline constexpr std::array<std::string_view, 3> kModeNames{"hybrid", "raytrace", "raster"};

// How the CPU's mirrored and refracted light travels to the GPU.
enum class ReflectionFormat {
  none,
  rgb8,    // 3 bytes a pixel, sRGB, clipped at 1: the slides'
  rgb9e5,  // 4 bytes: 9 bits a colour, one exponent
  half,    // 6 bytes: exact to the picture's own format
  full,    // 12 bytes: float
};
inline constexpr std::array<std::string_view, 5> kReflectionFormatNames{"none", "rgb8", "rgb9e5", "half",
                                                                        "float"};
[[nodiscard]] int bytes_per_pixel(ReflectionFormat format);

// Who finds what each pixel sees, in design 1.
enum class Primary {
  raster,  // the GPU
  rays,    // the CPU: where a software rasteriser, on the same cores, would take longer
};
inline constexpr std::array<std::string_view, 2> kPrimaryNames{"raster", "rays"};

inline constexpr int kMostThreads = 1024;

// What a frame models and what travels between GPU and CPU for it.
struct Plan {
  Mode mode = Mode::hybrid;
  int design = 1;        // where the parts meet: 1, on the GPU; 2, on the CPU
  int id_bits = 32;      // of a triangle id on its way: 16, 24 or 32; the highest value is "none"
  bool normals = false;  // design 1: shading normals go to the CPU as well, 3 bytes a pixel
  bool wide = false;  // design 2: the 128-bit buffer of shaders/gbuffer.frag goes to the CPU, not ids alone
  int mask_bits = 0;  // a pixel: 0 (no shadow pass), 1, 2, 4 or 8
  ReflectionFormat reflection = ReflectionFormat::none;  // none: no reflection pass
  int depth = 0;                                         // most bounces
  bool precise = false;                                  // raytrace: drawn by core/reference, in double
  int threads = 0;                                       // workers; 0: all cores
  // Light that a ray brings its pixel, below which no ray is fired, linear. Shadow rays: 0, all are fired.
  float least_contribution = kLeastContribution, least_light = 0.0f;
  // Nothing is drawn or traced again for a frame that asks for what the last one did, and no shadow ray is fired
  // where earlier frames have shown that the light comes through (core/trace/lit_cells.h).
  bool reuse = true;

  // Design 1 alone:
  Primary primary = Primary::raster;
  int mask_scale = 1, reflection_scale = 1;  // 1, 2 or 4: one sample for so many pixels across and down
  bool tiles = false;                        // only tiles with some reflection in them are sent

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
  bool precise = false;      // raytrace: by the reference in double; other modes have none and ignore it
  int threads = 0;           // 0: all cores
  bool software_gl = false;  // the rasteriser runs on the tracer's cores
  bool reprojects = false;   // the newest raster is shown at once, so there must be one
  bool keeps_mask = true;    // the mask itself is wanted: every bit of it is asked for, seen or not
  glm::ivec2 size{800, 600};
};

// The least that draws the scene exactly (to half a step of an 8-bit picture), or the slides' fixed
// budget. An error where the scene needs what no plan has (more casting lights than mask slots, more
// triangles than 24-bit ids).
[[nodiscard]] Expected<Plan> make_plan(const Needs& needs, const PlanRequest& request);

// Whether the plan can draw a scene of these needs; an error names the setting (of the plan's JSON) that
// cannot be.
[[nodiscard]] Expected<void> check_plan(const Plan& plan, const Needs& needs);

// What a hybrid frame of this plan moves at most (with `tiles`: where every tile has reflection), bytes.
struct TrafficBytes {
  std::size_t to_cpu = 0, to_gpu = 0;
};
[[nodiscard]] TrafficBytes traffic_of(const Plan& plan, glm::ivec2 size);

[[nodiscard]] const char* mode_name(Mode mode);

}  // namespace pinocchio
