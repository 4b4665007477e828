// Part of walk/kernel.h's files: the pixels that a packet's light goes to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/trace/lanes/lane_steps.h"
#include "core/trace/lanes/shared.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The whole picture's pixels that the tile's samples belong to.
inline whole2 whole_picture_pixel(const Bounce& bounce, Int pixel) {
  pixel = pixel & Int(kSampledPixels - 1);
  const Int row = shift_right<kTileBits>(pixel), scale(bounce.scale);
  return {(pixel - shift_left<kTileBits>(row)) * scale + Int(bounce.corner.x),
          row * scale + Int(bounce.corner.y)};
}

// Adds the lanes' light to their pixels, lane after lane.
inline void add_light(const Vec& light, const std::uint32_t* pixel, Mask lanes, float* radiance) {
  using Row [[gnu::vector_size(16), gnu::may_alias, gnu::aligned(4)]] = float;  // of RGBA
  alignas(64) float rgb[3][kWidth];
  light.x.store(rgb[0]);
  light.y.store(rgb[1]);
  light.z.store(rgb[2]);
  for (unsigned waiting = lanes.bits(); waiting != 0; waiting &= waiting - 1) {
    const int lane = __builtin_ctz(waiting);
    Row& to = *reinterpret_cast<Row*>(radiance + 4 * std::size_t{pixel[lane]});
    to = to + Row{rgb[0][lane], rgb[1][lane], rgb[2][lane], 0.0f};
  }
}

inline void add_light(const Vec& light, Int pixels, Mask lanes, float* radiance) {
  alignas(64) std::uint32_t pixel[kWidth];
  pixels.store(pixel);
  add_light(light, pixel, lanes, radiance);
}

// The pixels of light that is found at random from here on.
inline Int sampled_pixel(const Bounce& bounce, Int pixel) {
  if (bounce.sampled == 0) return pixel;
  return select(pixel < Int(kSampledPixels), pixel + Int(bounce.sampled), pixel);
}

// Likewise, of light that comes straight from lights with a size.
inline Int lamp_pixel(const Bounce& bounce, Int pixel) {
  if (bounce.sampled == 0) return pixel;
  return select(pixel < Int(kSampledPixels), pixel + Int(bounce.sampled + kLampPixels), pixel);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
