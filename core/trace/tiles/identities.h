#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pinocchio/frame_arrays.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Writes the wanted layers that name what the triangles `ids` belong to (objects, materials, primitives),
// from place `first` of the arrays on.
void write_identities(const Scene& scene, std::span<const std::uint32_t> ids, const FrameArrays& to,
                      std::size_t first);

}  // namespace pinocchio
