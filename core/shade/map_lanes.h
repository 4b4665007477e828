// Between the lanes and materials with maps (shade/mapped_material.h).
#pragma once

#include <cstdint>

#include "core/shade/footprint.h"
#include "core/shade/lane_texture.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A packet's points, a column each.
struct MapLanes {
  using Column = float[kMostLanes];
  // Inputs.
  alignas(64) std::uint32_t triangle[kMostLanes];
  alignas(64) Column weights[3], origin[3], direction[3], p_world[3];
  alignas(64) Column n_shading[3];  // output too
  alignas(64) Column width;         // the ray's cone's at its origin
  unsigned leaving, layered;        // lanes; layered: the material has a clear coat or sheen
  // Outputs.
  alignas(64) Column ambient[3], diffuse[3], specular[3], emission[3], reflectance[3], transmittance[3];
  alignas(64) Column shininess, occlusion, ggx_alpha, grazing, layer[2], ior, alpha;
  unsigned fresnel, reflects, transmits, blends;  // lanes
  // Of layered lanes.
  alignas(64) Column sheen[3], sheen_alpha, coat, coat_alpha;
  unsigned coat_is_mapped;
};

// Fills the outputs of `lanes`, whose triangles' materials have maps; the others' are left as they are.
void map_lanes(const Mesh& mesh, const Footprint& footprint, SampleTexture sample, unsigned lanes,
               MapLanes& packet);

}  // namespace pinocchio
