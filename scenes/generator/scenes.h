#pragma once

#include <string>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

struct ProceduralOptions {
  // About how many; 0: as many as the scene has by itself. Of scenes of a fixed shape, an error.
  int triangles = 0;
  Progress* progress = nullptr;  // phase "generate"
};

// Scenes made by our own code, the same on every machine.
[[nodiscard]] std::vector<std::string> procedural_names();
[[nodiscard]] Expected<Scene> make_procedural(const std::string& name, const ProceduralOptions& options = {});

// The scenes behind make_procedural; `triangles` is about how many.
[[nodiscard]] Scene make_two_lights();
[[nodiscard]] Scene make_speedboat(int triangles, Progress* progress = nullptr);
[[nodiscard]] Scene make_cornell();
[[nodiscard]] Scene make_forest(int triangles, Progress* progress = nullptr);
[[nodiscard]] Scene make_spd_balls(int triangles, Progress* progress = nullptr);

}  // namespace pinocchio
