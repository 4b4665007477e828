// The formats of what travels, and the pictures they stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/parallel/workers.h"
#include "gl/texture.h"
#include "pinocchio/image.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// How ids are stored and travel, and the value (of a component) that says nothing is seen.
struct IdFormat {
  gl::PixelFormat pixel;
  std::uint32_t none;
};
[[nodiscard]] IdFormat id_format(int id_bits);

// Ids as the GPU sends them to 32 bits.
void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids);

// Ids out of design 2's 128-bit pixels.
void unpack_gbuffer_ids(std::span<const std::byte> bytes, Image<std::uint32_t>& ids);

// 32-bit ids as the plan has them travel, the other way.
void pack_ids(const Image<std::uint32_t>& ids, int id_bits, std::span<std::byte> bytes);

// RGB travels as one component a texel, three texels a pixel: a driver may have no three-component format
// of its own and convert, at ten times a copy's cost. rgb9e5 is one texel.
inline constexpr int kComponents = 3;
struct TexelFormat {
  gl::PixelFormat pixel;
  int texels;  // a pixel, side by side
};
[[nodiscard]] TexelFormat texel_format(ReflectionFormat format);
[[nodiscard]] inline glm::ivec2 component_size(glm::ivec2 size) {
  return {kComponents * size.x, size.y};
}

// Linear light in the reflection's format, rounded to nearest; what is too bright for it is clipped.
void pack_pixels(std::span<const glm::vec3> radiance, ReflectionFormat format, std::byte* to);
void pack_radiance(const Image<glm::vec3>& radiance, ReflectionFormat format, Workers& workers,
                   std::span<std::byte> bytes);

// A picture at one sample for scale x scale pixels.
[[nodiscard]] inline glm::ivec2 scaled_size(glm::ivec2 size, int scale) {
  return (size + scale - 1) / scale;
}

// sRGB bytes to linear light and back.
void unpack_srgb(std::span<const glm::u8vec3> srgb, Workers& workers, Image<glm::vec3>& light);
void pack_srgb(const Image<glm::vec3>& light, Workers& workers, std::span<std::byte> bytes);

// Half RGBA to floats.
void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color);

}  // namespace pinocchio
