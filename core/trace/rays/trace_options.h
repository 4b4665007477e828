#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/shade/shared.h"
#include "pinocchio/backfaces.h"
#include "pinocchio/background.h"
#include "pinocchio/conversion.h"
#include "pinocchio/glass_shadows.h"
#include "pinocchio/ray.h"
#include "pinocchio/sampled_light.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

namespace shared {
[[nodiscard]] inline bool operator==(const Sampling& a, const Sampling& b) {
  return a.sequence == b.sequence && a.index == b.index && a.seed == b.seed && a.count == b.count;
}
}  // namespace shared

// TraceOptions::light_cutoff for that number of lights: what all of them leave out stays below
// kThroughputCutoff.
[[nodiscard]] constexpr float light_cutoff_of(int lights) {
  return kThroughputCutoff / as_float(lights > 1 ? lights : 1);
}

// Behind the last bounce, rays still go straight on through so many surfaces that blend: hair and leaves are
// many layers.
inline constexpr int kStraightBeyond = 64;

// How rays are followed and points shaded. Everything that traces or shades reads this one value: the tile
// pass, batches of pictures, the bounce step, the GPU's passes and the reference.
struct TraceOptions {
  // Mirrored and refracted rays, and the shadow rays of what they hit, are not fired where they would bring
  // their pixel less light than this, linear.
  float throughput_cutoff = kThroughputCutoff;
  // Visible points without textures fire no shadow ray that would bring less light than this, linear. Points
  // with textures fire one at each light that their triangle faces. 0: every bit of the mask is exact.
  float light_cutoff = 0.0f;
  float texture_footprint = 1.0f;  // side of the square that textures are averaged over, pixels; 0: a point
  bool clear_ways = true;          // shadow rays that are known to be free are not traced (core/bsp/clear)
  Terminator terminator = kUsualTerminator;
  Backfaces backfaces = Backfaces::automatic;  // which backs the camera's rays pass
  EnvironmentMethod environment_light = EnvironmentMethod::sampled;
  Glossy glossy = Glossy::sampled;
  int sky_occlusion = 0;  // shadow rays about the normal for a prefiltered environment; 0: it casts none
  // Share of the prefiltered environment's hidden light that is kept, times the point's albedo: an estimate
  // of the light that comes from what hides it.
  float sky_bounce = 0.0f;
  bool denoise = false;  // light that is found at random is kept apart for the filter (core/denoise)
  GlassShadows glass_shadows = kUsualGlassShadows;
  Background background{};                // behind the scene ...
  float background_blur = 0.0f;           // ... and how far a picture there is blurred (backdrop_of)
  std::optional<float> catcher_height{};  // world y of the shadow catcher (pinocchio/shadow_catcher.h)
  glm::vec2 jitter{0.0f};                 // View's: seeds decisions at random, different for each sample
  shared::Sampling sampling{};            // the sample of sized lights, rough mirrors and the environment

  friend bool operator==(const TraceOptions&, const TraceOptions&) = default;
};

}  // namespace pinocchio
