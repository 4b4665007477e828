#pragma once

#include <cstdint>

#include "core/bsp/clear/clear_way.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// Whether some points of the material may be known to mirror nothing, to transmit nothing and not to blend.
[[nodiscard]] bool may_be_rough(const Mesh& mesh, const Material& m);

// The longest footprint, scene units across the triangle, that finds all of that part too rough to mirror:
// textures may be averaged over it anywhere there. Infinite: the material mirrors nothing, transmits nothing
// and does not blend. 0: no footprint surely does, or the search would take too long.
[[nodiscard]] float rough_within(const Mesh& mesh, std::uint32_t triangle, const TrianglePart& part);

}  // namespace pinocchio
