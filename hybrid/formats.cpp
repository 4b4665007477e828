#include "hybrid/formats.h"

#include <ImathConfig.h>
#include <half.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace pinocchio {
namespace {

constexpr float kLargestHalf = 65504.0f;

std::uint16_t half_bits(float value) {
  return half(std::min(value, kLargestHalf)).bits();
}

float from_half_bits(std::uint16_t bits) {
  return half(half::FromBits, bits);
}

}  // namespace

void unpack_ids(std::span<const std::byte> bytes, int id_bits, Image<std::uint32_t>& ids) {
  assert(bytes.size() == ids.pixels().size() * static_cast<std::size_t>(id_bits / 8));
  if (id_bits == 32) {
    std::memcpy(ids.pixels().data(), bytes.data(), bytes.size());
    return;
  }
  const auto* narrow = reinterpret_cast<const std::uint16_t*>(bytes.data());
  std::transform(narrow, narrow + ids.pixels().size(), ids.pixels().begin(),
                 [](std::uint16_t id) { return id == 0xffffu ? 0xffffffffu : std::uint32_t{id}; });
}

void pack_radiance(const Image<glm::vec3>& radiance, Workers& workers, std::span<std::byte> bytes) {
  assert(bytes.size() == radiance.pixels().size() * 3 * sizeof(std::uint16_t));
  auto* const halves = reinterpret_cast<std::uint16_t*>(bytes.data());
  const auto width = static_cast<std::size_t>(radiance.width());
  workers.for_each(static_cast<std::size_t>(radiance.height()), [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i)
      for (int c = 0; c < 3; ++c) halves[3 * i + static_cast<std::size_t>(c)] = half_bits(radiance[i][c]);
  });
}

void unpack_picture(std::span<const std::byte> bytes, Image<glm::vec4>& color) {
  assert(bytes.size() == color.pixels().size() * 4 * sizeof(std::uint16_t));
  const auto* halves = reinterpret_cast<const std::uint16_t*>(bytes.data());
  for (std::size_t i = 0; i < color.pixels().size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) color[i][static_cast<int>(c)] = from_half_bits(halves[4 * i + c]);
}

}  // namespace pinocchio
