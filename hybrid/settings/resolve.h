#pragma once

#include <glm/glm.hpp>

#include "hybrid/settings/scene_stats.h"
#include "pinocchio/error.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// Everything beside the scene that settings are resolved by.
struct Circumstances {
  glm::ivec2 size{800, 600};  // of the drawn part, pixels
  bool software_gl = false;   // the rasteriser runs on the tracer's cores
  bool keeps_mask = true;     // every bit of the mask is wanted, visible or not
  bool needs_rays = false;    // OpenGL cannot draw the view (View::is_rasterisable): the CPU draws alone
};

// The gain of the CPU alone over hybrid with a software OpenGL (docs/measurements.md, "Who draws"). It holds
// for every scene and size that was measured, so by_machine needs no other fact.
inline constexpr const char* kGainOverSoftwareGl = "1.5 to 4 times as fast at 800x600";

// Fills in the settings that are not given: the least work that draws the scene exactly (to half a step of an
// 8-bit picture). An error where two settings contradict each other or the scene (a mask or ids with too few
// bits).
[[nodiscard]] Expected<Settings> resolve(const Settings& settings, const SceneStats& stats,
                                         const Circumstances& circumstances = {});

// The bits of the mask that goes to the GPU, where they are not given.
[[nodiscard]] int mask_bits_for(int casting_lights);
// Whether some of the casting lights are beyond the mask that goes to the GPU, and their light is added to
// the mirrored light.
[[nodiscard]] bool adds_lights(const Settings& resolved, int casting_lights);

// The picture's losses by given settings, one line each; empty: none.
[[nodiscard]] std::vector<std::string> losses(const Settings& resolved, const SceneStats& stats);

}  // namespace pinocchio
