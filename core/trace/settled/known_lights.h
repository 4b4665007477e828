#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/bsp/clear/clear_ways.h"
#include "core/shade/shared.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A light without a size that casts shadows.
struct MaskLight {
  shared::LightParams params;
  std::uint8_t bit;  // of the mask's byte
  std::shared_ptr<const ClearWays> ways;
};

// A whole triangle's inside, or part `number` of it.
struct PartOfMesh {
  std::uint32_t triangle;
  std::optional<std::uint32_t> number;
};

// Whether it may be known which lights reach points of the material.
[[nodiscard]] bool may_know_lights(const Material& m);

// The bits of the lights that surely reach all points of that part, if the others surely reach none: what the
// bounce step would find with TraceOptions::light_cutoff `cutoff`, at points that are seen from the front
// (from where the corners turn counterclockwise) or from the back. None: that differs from point to point, or
// is not certain.
[[nodiscard]] std::optional<std::uint8_t> known_lights(const Mesh& mesh, const PartOfMesh& part,
                                                       bool from_front, const std::vector<MaskLight>& lights,
                                                       float cutoff);

}  // namespace pinocchio
