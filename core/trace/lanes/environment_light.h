#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/shade/shared.h"
#include "core/trace/rays/ray_queue.h"
#include "pinocchio/environment.h"
#include "pinocchio/scene.h"

namespace pinocchio {
namespace shared {

struct EnvironmentTexels {
  const glm::vec3* pixels;
  int width;
};

[[nodiscard]] inline vec3 environment_texel(const EnvironmentTexels& texels, ivec2 at) {
  return texels.pixels[static_cast<std::ptrdiff_t>(at.y) * texels.width + at.x];
}

#define SHARED [[nodiscard]] inline
#include "shaders/shared/environment.glsl"
#undef SHARED

}  // namespace shared

// What a packet of lanes samples, a column each. The sampling is compiled once for all instruction sets, so
// that they have the same bits.
struct SampleLanes {
  using Column = float[kQueuePad];
  alignas(64) Column number[2];     // in [0, 1)
  alignas(64) Column direction[3];  // unit
  alignas(64) Column light[3];      // from there, divided by the direction's density
  alignas(64) Column density;       // per steradian
};

// A scene's environment as rays read it.
class EnvironmentLight {
 public:
  // The scene has an environment.
  explicit EnvironmentLight(const Scene& scene);

  [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const {
    return shared::environment_light(params_, direction);
  }
  // A direction from two numbers. Directions that more light comes from are likelier.
  void sample(unsigned lanes, SampleLanes& packet) const;
  // The light from the packet's directions, not divided, and the density with which sample() finds them.
  void look_up(unsigned lanes, SampleLanes& packet) const;
  // The density of sample()'s directions at this one, per steradian.
  [[nodiscard]] float density(const glm::vec3& direction) const;
  [[nodiscard]] bool shines() const { return shines_; }

 private:
  const Environment* environment_;
  shared::EnvironmentParams params_;
  bool shines_;
};

}  // namespace pinocchio
