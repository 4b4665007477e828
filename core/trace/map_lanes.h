// Between the lanes and materials with maps (trace/mapped_material.h).
#pragma once

#include <cstdint>

#include "core/trace/footprint.h"
#include "core/trace/lane_texture.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A packet's points, a column each.
struct MapLanes {
  using Column = float[kMostLanes];
  // Asked.
  alignas(64) std::uint32_t triangle[kMostLanes];
  alignas(64) Column weights[3], origin[3], direction[3], p_world[3];
  alignas(64) Column n_shading[3];  // and answered
  alignas(64) Column width;         // of the ray's cone at its origin
  unsigned leaving;                 // lanes
  // Answered.
  alignas(64) Column ambient[3], diffuse[3], specular[3], emission[3], reflectance[3], transmittance[3];
  alignas(64) Column shininess, ior, alpha;
  unsigned fresnel, reflects, transmits, blends;  // lanes
};

// For `lanes`, whose triangles' materials have maps; the others' columns are left as they are.
void map_lanes(const Mesh& mesh, const Footprint& footprint, SampleTexture sample, unsigned lanes,
               MapLanes& packet);

}  // namespace pinocchio
