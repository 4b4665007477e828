#pragma once

#include <glm/glm.hpp>

#include "hybrid/settings/scene_stats.h"
#include "pinocchio/error.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// What the settings of a frame depend on beside the scene.
struct Circumstances {
  glm::ivec2 size{800, 600};  // of the part that is drawn, pixels
  bool software_gl = false;   // the rasteriser runs on the tracer's cores
  bool keeps_mask = true;     // the mask itself is wanted: every bit of it is asked for, seen or not
};

// How much faster the CPU alone draws than hybrid where OpenGL is software, 800x600 (docs/measurements.md,
// "Who draws"): the same on every scene and size measured, so that by_machine asks for nothing else.
inline constexpr const char* kGainOverSoftwareGl = "1.5 to 4 times as fast at 800x600";

// Fills in what nobody set: the least that draws the scene exactly (to half a step of an 8-bit picture). An
// error where two settings contradict each other, or the scene needs what there is not (more casting lights
// than mask slots, ids with too few bits).
[[nodiscard]] Expected<Settings> resolve(const Settings& settings, const SceneStats& stats,
                                         const Circumstances& circumstances = {});

// What the picture loses by settings that the user gave, one line each; empty: nothing.
[[nodiscard]] std::vector<std::string> losses(const Settings& resolved, const SceneStats& stats);

}  // namespace pinocchio
