#include "hybrid/exchange/encode.h"

#include <half.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/image/tonemap.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr int kComponents = 3;

std::uint16_t half_bits(float value) {
  return half(std::clamp(value, -kLargestHalf, kLargestHalf)).bits();
}

float from_half_bits(std::uint16_t bits) {
  return half(half::FromBits, bits);
}

// Calls body(first, end) with each row's range of pixels, on all threads.
template <class Body>
void for_each_row(glm::ivec2 size, Workers& workers, Body body) {
  const auto width = as_size(size.x);
  workers.for_each(as_size(size.y), [&](std::size_t row) { body(row * width, (row + 1) * width); });
}

// The conversion of OpenGL's EXT_texture_shared_exponent: the exponent is the brightest colour's.
std::uint32_t rgb9e5_bits(const glm::vec3& light) {
  constexpr int kMantissaBits = 9, kBias = 15;
  constexpr float kLargest = 65408.0f;  // (2^9 - 1) / 2^9 * 2^16
  const glm::vec3 c = glm::clamp(light, 0.0f, kLargest);
  int exponent = std::max(-kBias - 1, std::ilogb(std::max({c.r, c.g, c.b, 0x1p-30f}))) + 1 + kBias;
  const auto mantissa = [&](float v) {
    return as_uint32(std::floor(std::ldexp(v, kMantissaBits + kBias - exponent) + 0.5f));
  };
  if (mantissa(std::max({c.r, c.g, c.b})) == 1u << kMantissaBits) ++exponent;
  return mantissa(c.r) | mantissa(c.g) << 9u | mantissa(c.b) << 18u | as_uint32(exponent) << 27u;
}

void pack_srgb8(std::span<const glm::vec3> radiance, std::byte* to) {
  for (const glm::vec3& light : radiance)
    for (int c = 0; c < kComponents; ++c) *to++ = static_cast<std::byte>(linear_to_srgb8(light[c]));
}

void pack_rgb9e5(std::span<const glm::vec3> radiance, std::byte* to) {
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const std::uint32_t bits = rgb9e5_bits(radiance[i]);
    std::memcpy(to + i * sizeof(bits), &bits, sizeof(bits));
  }
}

void pack_halves(std::span<const glm::vec3> radiance, std::byte* to) {
  auto* halves = reinterpret_cast<std::uint16_t*>(to);
  for (const glm::vec3& light : radiance)
    for (int c = 0; c < kComponents; ++c) *halves++ = half_bits(light[c]);
}

void pack_floats(std::span<const glm::vec3> radiance, std::byte* to) {
  std::memcpy(to, radiance.data(), radiance.size_bytes());
}

// By ReflectionFormat.
constexpr std::array<Packing, kReflectionFormatNames.size()> kPackings{{
    {gl::kRgb8, gl::kR8, false, nullptr},
    {gl::kRgb8, gl::kR8, true, pack_srgb8},
    {gl::kRgb9E5, gl::kRgb9E5, false, pack_rgb9e5},
    {gl::kRgb16F, gl::kR16F, false, pack_halves},
    {gl::kRgb32F, gl::kR32F, false, pack_floats},
}};

constexpr int kWidestTexture = 16384;  // that every OpenGL 4.1 and later has

}  // namespace

IdFormat id_format(int id_bits) {
  if (id_bits == 16) return {gl::kR16Ui, 0xffffu};
  if (id_bits == 24) return {gl::kId24, 0xffu};
  return {gl::kR32Ui, 0xffffffffu};
}

void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids) {
  assert(bytes.size() == ids.pixels().size() * as_size(id_bits / 8));
  if (id_bits == 32) {
    std::memcpy(ids.pixels().data(), bytes.data(), bytes.size());
  } else if (id_bits == 16) {
    const auto* narrow = reinterpret_cast<const std::uint16_t*>(bytes.data());
    std::transform(narrow, narrow + ids.pixels().size(), ids.pixels().begin(),
                   [](std::uint16_t id) { return id == 0xffffu ? 0xffffffffu : std::uint32_t{id}; });
  } else {
    const auto* b = reinterpret_cast<const std::uint8_t*>(bytes.data());
    for (std::uint32_t& id : ids.pixels()) {
      id = b[0] | as_uint32(b[1]) << 8 | as_uint32(b[2]) << 16;
      if (id == 0xffffffu) id = 0xffffffffu;
      b += 3;
    }
  }
}

void unpack_gbuffer_ids(std::span<const std::byte> bytes, Image<std::uint32_t>& ids) {
  assert(bytes.size() == ids.pixels().size() * gl::kRgba32Ui.bytes);
  const auto* words = reinterpret_cast<const std::uint32_t*>(bytes.data());
  for (std::size_t i = 0; i < ids.pixels().size(); ++i) ids[i] = words[4 * i];
}

void pack_ids(const Image<std::uint32_t>& ids, int id_bits, std::span<std::byte> bytes) {
  const auto id_bytes = as_size(id_bits / 8);
  assert(bytes.size() == ids.pixels().size() * id_bytes);
  std::byte* to = bytes.data();
  for (const std::uint32_t id : ids.pixels()) {  // "none" is all ones in any number of bits
    for (std::size_t k = 0; k < id_bytes; ++k) to[k] = static_cast<std::byte>(id >> 8 * k);
    to += id_bytes;
  }
}

const Packing& packing(ReflectionFormat format) {
  return kPackings[as_size(format)];
}

int bytes_per_pixel(ReflectionFormat format) {
  const Packing& pack = packing(format);
  return pack.pack ? as_int(pack.pixel.bytes) : 0;
}

PackedTexels packed_texels(ReflectionFormat format, glm::ivec2 pixels) {
  const Packing& pack = packing(format);
  if (pack.component == pack.pixel || kComponents * pixels.x > kWidestTexture) return {pack.pixel, pixels};
  return {pack.component, {kComponents * pixels.x, pixels.y}};
}

void pack_radiance(const Image<glm::vec3>& radiance, ReflectionFormat format, Workers& workers,
                   std::span<std::byte> bytes) {
  const auto pixel_bytes = as_size(bytes_per_pixel(format));
  assert(bytes.size() == radiance.pixels().size() * pixel_bytes);
  for_each_row(radiance.size(), workers, [&](std::size_t first, std::size_t end) {
    packing(format).pack({&radiance[first], end - first}, bytes.data() + first * pixel_bytes);
  });
}

void unpack_srgb(std::span<const glm::u8vec3> srgb, Workers& workers, Image<glm::vec3>& light) {
  assert(srgb.size() == light.pixels().size());
  for_each_row(light.size(), workers, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      light[i] = {srgb8_to_linear(srgb[i].r), srgb8_to_linear(srgb[i].g), srgb8_to_linear(srgb[i].b)};
  });
}

void pack_srgb(const Image<glm::vec3>& light, Workers& workers, std::span<std::byte> bytes) {
  pack_radiance(light, ReflectionFormat::rgb8, workers, bytes);
}

void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color) {
  assert(bytes.size() == color.pixels().size() * 4 * sizeof(std::uint16_t));
  const auto* halves = reinterpret_cast<const std::uint16_t*>(bytes.data());
  for (std::size_t i = 0; i < color.pixels().size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) color[i][as_int(c)] = from_half_bits(halves[4 * i + c]);
}

}  // namespace pinocchio
