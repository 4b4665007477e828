// Lengths that a binary glTF's header holds: 32 bits each.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace pinocchio {

inline constexpr std::uint64_t kMostGlbBytes = std::numeric_limits<std::uint32_t>::max();

// A chunk's bytes with what fills it up to whole words.
constexpr std::uint64_t padded_to_words(std::uint64_t bytes) {
  return (bytes + 3) / 4 * 4;
}

// The file's bytes, of a chunk of JSON and one of binary data; none where the header cannot hold the number.
constexpr std::optional<std::uint64_t> glb_bytes(std::uint64_t json, std::uint64_t binary) {
  constexpr std::uint64_t kHeaders = 12 + 8 + 8;
  if (json > kMostGlbBytes || binary > kMostGlbBytes) return std::nullopt;
  const std::uint64_t all = kHeaders + padded_to_words(json) + padded_to_words(binary);
  return all <= kMostGlbBytes ? std::optional(all) : std::nullopt;
}

}  // namespace pinocchio
