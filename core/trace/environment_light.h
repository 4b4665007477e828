#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/trace/ray_queue.h"
#include "core/trace/shared.h"
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

// Of a packet of lanes, a column each: what they sample. Code of its own, compiled once for all instruction
// sets, so that they have the same bits.
struct SampleLanes {
  using Column = alignas(64) float[kQueuePad];
  Column number[2];     // in [0, 1)
  Column direction[3];  // unit
  Column light[3];      // that comes from there, over how likely the direction was
};

// A scene's environment as rays ask for it.
class EnvironmentLight {
 public:
  // The scene has one.
  explicit EnvironmentLight(const Scene& scene);

  [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const {
    return shared::environment_light(params_, direction);
  }
  // A direction from two numbers, likelier the more light comes from there.
  void sample(unsigned lanes, SampleLanes& packet) const;
  [[nodiscard]] bool shines() const { return shines_; }

 private:
  const Environment* environment_;
  shared::EnvironmentParams params_;
  bool shines_;
};

}  // namespace pinocchio
