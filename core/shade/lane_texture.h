// Between materials with maps (shade/map_lanes.h) and the lanes that look their textures up
// (trace/lanes/texture.h).
#pragma once

#include "pinocchio/texture.h"

namespace pinocchio {

inline constexpr unsigned kMostLanes = 16;

struct LaneTexture {
  const void *first_level, *others;  // 32 bits a texel; the smaller levels, one after the other
  int width, height, levels;         // the first level's size
  Wrap wrap_u, wrap_v;
  bool nearest;
  bool is_color;                   // sRGB
  const float* linear_from_srgb8;  // 256
};

// A column each.
struct TexturePoints {
  using Column = float[kMostLanes];
  alignas(64) Column uv[2];
  alignas(64) Column change_x[2], change_y[2];  // of uv from a pixel to the next; zero: not filtered
  alignas(64) Column texel[4];                  // output: RGBA
};

using SampleTexture = void (*)(const LaneTexture& texture, unsigned lanes, TexturePoints& points);

}  // namespace pinocchio
