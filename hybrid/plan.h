#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/base/error.h"
#include "hybrid/needs.h"

namespace pinocchio {

// Who draws.
enum class Mode { hybrid, raytrace, raster };

// What a frame models and what travels between GPU and CPU for it.
struct Plan {
  Mode mode = Mode::hybrid;
  int id_bits = 32;         // of a triangle id on its way to the CPU: 16 or 32; the highest value is "none"
  int mask_bits = 0;        // a pixel: 0 (no shadow pass), 1, 2, 4 or 8
  bool reflection = false;  // whether there is a reflection pass; its result travels as half RGB
  int depth = 0;            // most bounces

  // Whether anything is left for the CPU to trace.
  [[nodiscard]] bool traces() const { return mask_bits > 0 || reflection; }
};

// The least that draws the scene exactly. An error where the scene needs what no plan has (more casting
// lights than mask slots).
[[nodiscard]] Expected<Plan> make_plan(const Needs& needs, Mode mode, int depth);

[[nodiscard]] const char* mode_name(Mode mode);
[[nodiscard]] nlohmann::json to_json(const Plan& plan);

}  // namespace pinocchio
