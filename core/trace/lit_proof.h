#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/bsp/tree.h"
#include "core/trace/shared.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A piece of a triangle as seen from one side.
struct CellPlace {
  std::uint32_t triangle;
  bool back;                          // from where its corners go round clockwise
  std::array<glm::dvec2, 3> weights;  // of the triangle's corners b and c, at the cell's corners
};

// What can be said of every shadow ray of a cell, by error-bound offset, before any is fired.
enum class Proof {
  none,
  lit,          // the surface faces the light, which is no dimmer than asked for, and nothing is in between
  turned_away,  // the surface does not face the light
};

// Never more than rays would find. least_light: as in TraceJob.
[[nodiscard]] Proof prove(const Mesh& mesh, const BspTree& tree, const CellPlace& place,
                          const shared::LightParams& light, float least_light);

}  // namespace pinocchio
