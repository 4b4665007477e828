#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/tiles/holes.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// Whether a share of a shadow ray's light goes on through the material: through glass, or what blends.
[[nodiscard]] bool passes_light(const Mesh& mesh, const Material& material, const TraceOptions& options);
// True if passes_light() is, for some material of the mesh.
[[nodiscard]] bool tints_shadows(const Mesh& mesh, const TraceOptions& options);

// Shadow rays that go straight on through glass and what blends, surface by surface (lanes/glass.h). Scenes
// with neither never come here.
class TintedShadows {
 public:
  // What is left of a shadow ray's light that came through nothing but glass, what blends and what absorbs
  // it.
  struct Lit {
    std::uint32_t ray;  // its place in the queue
    glm::vec3 light;
  };

  // blocked[i] = 0 where nothing takes light from shadow ray i, else 1. Returns the rays that may pass
  // something, for go_on(); `pixel` is the ray's place in `rays`. Their light may be set until then.
  RayQueue& begin(const Tracer& tracer, const PassedSurfaces& passed, const RayQueue& rays, float reach,
                  std::uint8_t* blocked);
  // blocked[i] = 0 also where ray i meets nothing but holes, and does not end in a medium. A ray ends where
  // its light is below the options' cutoff. bounce: the step that the rays are from.
  void go_on(const Tracer& tracer, const Bounce& bounce, float reach, std::uint8_t* blocked);

  // The rays that came to their light in the last go_on().
  [[nodiscard]] std::span<const Lit> lit() const { return lit_; }

 private:
  void keep_going(const std::uint32_t* holes, float least, std::uint8_t* blocked);

  RayQueue on_;                          // `pixel` is the ray's place in the queue that it is from
  std::vector<std::uint8_t> is_tinted_;  // by ray of on_: not 0: something was taken from its light
  MetHoles met_;
  std::vector<Lit> lit_;
};

}  // namespace pinocchio
