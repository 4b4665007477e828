// Functions of the lanes that only tests call by themselves, compiled for each instruction set as the kernels
// are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/shade/lane_maps.h"
#include "core/shade/shared.h"
#include "core/simd/isas.h"
#include "core/trace/lanes/environment_params.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// An operation of core/simd/lanes.h, applied to the bits of two numbers. A comparison gives 1 or 0.
enum class LaneOp {
  min,
  max,
  less,
  less_equal,
  equal,
  not_less,
  abs,
  sqrt,
  floor,
  add,
  multiply,
  divide,
  to_float,
  to_int,
  whole_less,
  shift_left,
  shift_right,
  shift_in_zeros,
  through_double,
  double_min_max,
  gather,
  packed,
};

struct TileRays;

// A triangle in the pixels of a tile (lanes/settled.h), row by row.
struct MetInTile {
  std::array<std::array<float, 1024>, 3> above;
  std::array<float, 1024> total;
  float least_total, least_for_parts, footprint;
  bool from_front;
};

// `count`: a multiple of 16.
struct LaneProbe {
  Isa isa;
  unsigned width;  // lanes
  // The points of `dimension` of the pixels (x, y).
  void (*samples)(const shared::Sampling& sampling, const std::uint32_t* x, const std::uint32_t* y,
                  std::uint32_t dimension, float* u, float* v, std::size_t count);
  // x^y for x > 0.
  void (*power)(const float* x, const float* y, float* result, std::size_t count);
  // The parts of triangles (part_of_inside) in which points with these weights of the second and third corner
  // are.
  void (*parts)(const float* y, const float* z, std::uint32_t* number, std::size_t count);
  void (*met_in_tile)(const TileRays& rays, const std::array<glm::vec3, 3>& corners, MetInTile& met);
  SampleTextures sample_textures;
  // A channel of the place's texture at `points`, not filtered.
  void (*channel)(const TexturePlace& place, unsigned lanes, int channel, const TexturePoints& points,
                  float* result);
  // The environment's light from directions, three columns each, and its samples' density there.
  void (*environment_light)(const EnvironmentLight& environment, const float* const* direction,
                            float* const* light, float* density, std::size_t count);
  // Its samples by two numbers each: directions, and light divided by the density.
  void (*environment_samples)(const EnvironmentLight& environment, const float* u, const float* v,
                              float* const* direction, float* const* light, float* density,
                              std::size_t count);
  // result[i]: the operation on a[i] and b[i]. gather: the word of `b` at a[i] & 15 where b[i] is odd, else
  // 0. packed: the a[i] whose b[i] is odd, first in each 16, then zeros.
  void (*values)(LaneOp op, const std::uint32_t* a, const std::uint32_t* b, std::uint32_t* result,
                 std::size_t count);
  // Cosine and sine of angles in revolutions.
  void (*angles)(const float* revolutions, float* cosine, float* sine, std::size_t count);
};

#define PINOCCHIO_DECLARE_PROBE(name, lanes, feature) \
  namespace name {                                    \
  extern const LaneProbe kProbe;                      \
  }
PINOCCHIO_ISAS(PINOCCHIO_DECLARE_PROBE)
#undef PINOCCHIO_DECLARE_PROBE

// The processor has them.
[[nodiscard]] inline const LaneProbe& lane_probe(Isa isa) {
#define PINOCCHIO_PROBE(name, lanes, feature) &name::kProbe,
  const LaneProbe* const probes[] = {PINOCCHIO_ISAS(PINOCCHIO_PROBE)};
#undef PINOCCHIO_PROBE
  return **std::find_if(std::begin(probes), std::end(probes),
                        [isa](const LaneProbe* p) { return p->isa == isa; });
}

}  // namespace pinocchio
