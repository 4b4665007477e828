#pragma once

#include <glm/glm.hpp>
#include <tuple>

#include "core/trace/shared.h"
#include "pinocchio/ray.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// How rays are followed and points shaded. Everything that traces or shades reads this one value: the tile
// pass, batches of pictures, the bounce step, the GPU's passes and the reference.
struct TraceOptions {
  // Light that a ray brings its pixel, linear, below which it is not fired: mirrored and refracted rays and
  // the shadow rays of what they see.
  float throughput_cutoff = kThroughputCutoff;
  // The same for shadow rays of visible points. 0: all are fired, so that every bit of the mask is true.
  float light_cutoff = 0.0f;
  float texture_footprint = 1.0f;  // side of the square that textures are averaged over, pixels; 0: a point
  Terminator terminator = kUsualTerminator;
  glm::vec2 jitter{0.0f};       // View's: tells the samples of a pixel apart where they decide at random
  shared::Sampling sampling{};  // which sample is taken of lights with a size, rough mirrors and the sky

  friend bool operator==(const TraceOptions& a, const TraceOptions& b) {
    const auto values = [](const TraceOptions& o) {
      return std::tie(o.throughput_cutoff, o.light_cutoff, o.texture_footprint, o.terminator, o.jitter,
                      o.sampling.sequence, o.sampling.index, o.sampling.seed);
    };
    return values(a) == values(b);
  }
};

}  // namespace pinocchio
