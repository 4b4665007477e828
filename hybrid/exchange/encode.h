// The formats that pictures travel in: what packs and unpacks them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/parallel/workers.h"
#include "gl/objects/texture.h"
#include "pinocchio/image.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// How ids are stored and travel, and the value of a component where nothing is seen.
struct IdFormat {
  gl::PixelFormat pixel;
  std::uint32_t none;
};
[[nodiscard]] IdFormat id_format(int id_bits);

// From the GPU's ids to ids of 32 bits.
void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids);

// From design 2's 128-bit pixels.
void unpack_gbuffer_ids(std::span<const std::byte> bytes, Image<std::uint32_t>& ids);

// From ids of 32 bits to the GPU's.
void pack_ids(const Image<std::uint32_t>& ids, int id_bits, std::span<std::byte> bytes);

// How light is packed on its way.
struct Packing {
  gl::PixelFormat pixel;      // one texel a pixel
  gl::PixelFormat component;  // where RGB may be three texels a pixel, each of them
  bool is_srgb;               // the values have the sRGB curve, which the shader removes
  void (*pack)(std::span<const glm::vec3> radiance, std::byte* to);  // null: nothing travels
};
[[nodiscard]] const Packing& packing(ReflectionFormat format);

// The texels of a packed picture. Where its width allows, RGB is three texels a pixel, side by side: a driver
// may have no three-component format of its own and convert, at ten times a copy's cost.
struct PackedTexels {
  gl::PixelFormat texel;
  glm::ivec2 size;
};
[[nodiscard]] PackedTexels packed_texels(ReflectionFormat format, glm::ivec2 pixels);
// How many of them a pixel has.
[[nodiscard]] inline int texels_a_pixel(const gl::Texture& packed) {
  return packed.format().format == GL_RED ? 3 : 1;
}

// Linear light in that format, rounded to nearest; too bright values are clipped.
void pack_radiance(const Image<glm::vec3>& radiance, ReflectionFormat format, Workers& workers,
                   std::span<std::byte> bytes);

// The samples of a picture that has one for scale x scale pixels.
[[nodiscard]] inline glm::ivec2 scaled_size(glm::ivec2 size, int scale) {
  return (size + scale - 1) / scale;
}

// sRGB bytes to linear light and back.
void unpack_srgb(std::span<const glm::u8vec3> srgb, Workers& workers, Image<glm::vec3>& light);
void pack_srgb(const Image<glm::vec3>& light, Workers& workers, std::span<std::byte> bytes);

// Half RGBA to floats.
void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color);

}  // namespace pinocchio
