// The steps of the filter that are computed in lanes (denoise/lanes.h), compiled once for each instruction
// set.
#pragma once

#include <cstddef>

#include "core/simd/isas.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// Levels of the filter. Level k reads pixels 2^k apart.
inline constexpr int kDenoiseLevels = 5;
// Pixels on each side that one level reads, in steps of the level.
inline constexpr int kDenoiseRadius = 2;
// Pixels around the picture that see nothing, so that a level may read beyond its edges.
inline constexpr int kDenoiseBorder = kDenoiseRadius << (kDenoiseLevels - 1);

// No pixel of the filtered picture depends on others that are further away, across or down: what all levels
// read, the estimate of the noise, and the slope of the distance.
inline constexpr int kDenoiseReach = kDenoiseRadius * ((1 << kDenoiseLevels) - 1) + kDenoiseRadius + 1;

// Planes of one number for each pixel. Each pointer is at the picture's first pixel; lines are `stride`
// apart, and kDenoiseBorder pixels beyond every edge, and a packet, can be read. Lines begin at a cache line.
struct DenoiseGuides {
  int width = 0;  // pixels
  std::ptrdiff_t stride = 0;
  const float* normal[3] = {};
  const float* distance = nullptr;  // infinite: nothing is seen, and the pixel is left out
  const float* albedo = nullptr;    // luminance
  float of_luminance = 0.0f;        // squared: standard deviations of the noise that count as x = 1 (lanes.h)
};

// Light divided by the albedo, and the variance of its luminance.
struct DenoiseLight {
  float* light[3] = {};
  float* variance = nullptr;
};

// What the weights compare: luminance, and its variance.
struct DenoiseContrast {
  float *luminance = nullptr, *variance = nullptr;
};

struct DenoiseSteps {
  // Writes line y of the variance, from the pixels around each pixel that see the same surface: the mean of
  // their variances, or, with `spatial`, the variance among them; and of the contrast, their mean's.
  void (*estimate)(const DenoiseGuides& guides, const DenoiseLight& from, bool spatial, int y,
                   float* variance, const DenoiseContrast& contrast);
  // Filters line y once with pixels `step` apart, by weights from `contrast`; null: from the light itself.
  void (*filter)(const DenoiseGuides& guides, const DenoiseLight& from, const DenoiseContrast* contrast,
                 const DenoiseLight& to, int step, int y);
};

// The processor has the instruction set.
[[nodiscard]] const DenoiseSteps& denoise_steps(Isa isa);

}  // namespace pinocchio
