// The formats of what travels, and the pictures they stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/image/image.h"
#include "core/parallel/workers.h"

namespace pinocchio {

// Ids as the GPU sends them (16 or 32 bits; all bits set: nothing seen) to 32 bits.
void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids);

// Linear light to half RGB, rounded to nearest; above 65504 clamped.
void pack_radiance(const Image<glm::vec3>& radiance, Workers& workers, std::span<std::byte> bytes);

// Half RGBA to floats.
void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color);

}  // namespace pinocchio
