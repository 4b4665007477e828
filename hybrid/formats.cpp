#include "hybrid/formats.h"

#include <half.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/image/tonemap.h"

namespace pinocchio {
namespace {

constexpr float kLargestHalf = 65504.0f;

std::uint16_t half_bits(float value) {
  return half(std::min(value, kLargestHalf)).bits();
}

float from_half_bits(std::uint16_t bits) {
  return half(half::FromBits, bits);
}

// Calls body(first, end) for each row's range of pixels, on all threads.
template <class Body>
void for_each_row(glm::ivec2 size, Workers& workers, Body body) {
  const auto width = static_cast<std::size_t>(size.x);
  workers.for_each(static_cast<std::size_t>(size.y),
                   [&](std::size_t row) { body(row * width, (row + 1) * width); });
}

void pack_halves(const Image<glm::vec3>& radiance, Workers& workers, std::span<std::byte> bytes) {
  assert(bytes.size() == radiance.pixels().size() * 3 * sizeof(std::uint16_t));
  auto* const halves = reinterpret_cast<std::uint16_t*>(bytes.data());
  for_each_row(radiance.size(), workers, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      for (int c = 0; c < 3; ++c) halves[3 * i + static_cast<std::size_t>(c)] = half_bits(radiance[i][c]);
  });
}

}  // namespace

IdFormat id_format(int id_bits) {
  if (id_bits == 16) return {gl::kR16Ui, 0xffffu};
  if (id_bits == 24) return {gl::kId24, 0xffu};
  return {gl::kR32Ui, 0xffffffffu};
}

void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids) {
  assert(bytes.size() == ids.pixels().size() * static_cast<std::size_t>(id_bits / 8));
  if (id_bits == 32) {
    std::memcpy(ids.pixels().data(), bytes.data(), bytes.size());
  } else if (id_bits == 16) {
    const auto* narrow = reinterpret_cast<const std::uint16_t*>(bytes.data());
    std::transform(narrow, narrow + ids.pixels().size(), ids.pixels().begin(),
                   [](std::uint16_t id) { return id == 0xffffu ? 0xffffffffu : std::uint32_t{id}; });
  } else {
    const auto* b = reinterpret_cast<const std::uint8_t*>(bytes.data());
    for (std::uint32_t& id : ids.pixels()) {
      id = b[0] | static_cast<std::uint32_t>(b[1]) << 8 | static_cast<std::uint32_t>(b[2]) << 16;
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

gl::PixelFormat component_format(ReflectionFormat format) {
  return format == ReflectionFormat::rgb8 ? gl::kR8 : gl::kR16F;
}

void pack_radiance(const Image<glm::vec3>& radiance, ReflectionFormat format, Workers& workers,
                   std::span<std::byte> bytes) {
  if (format == ReflectionFormat::rgb8) {
    pack_srgb(radiance, workers, bytes);
  } else {
    pack_halves(radiance, workers, bytes);
  }
}

void unpack_srgb(std::span<const glm::u8vec3> srgb, Workers& workers, Image<glm::vec3>& light) {
  assert(srgb.size() == light.pixels().size());
  for_each_row(light.size(), workers, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      light[i] = {srgb8_to_linear(srgb[i].r), srgb8_to_linear(srgb[i].g), srgb8_to_linear(srgb[i].b)};
  });
}

void pack_srgb(const Image<glm::vec3>& light, Workers& workers, std::span<std::byte> bytes) {
  assert(bytes.size() == light.pixels().size() * 3);
  auto* const to = reinterpret_cast<std::uint8_t*>(bytes.data());
  for_each_row(light.size(), workers, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      for (int c = 0; c < 3; ++c) to[3 * i + static_cast<std::size_t>(c)] = linear_to_srgb8(light[i][c]);
  });
}

void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color) {
  assert(bytes.size() == color.pixels().size() * 4 * sizeof(std::uint16_t));
  const auto* halves = reinterpret_cast<const std::uint16_t*>(bytes.data());
  for (std::size_t i = 0; i < color.pixels().size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) color[i][static_cast<int>(c)] = from_half_bits(halves[4 * i + c]);
}

}  // namespace pinocchio
