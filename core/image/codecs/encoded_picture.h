#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/files/memory_limit.h"
#include "pinocchio/texture.h"

namespace pinocchio {

struct DecodedImage {
  Texture texture;
  std::string damage;  // why a part of the picture could not be read; empty: all of it was
};

// A picture file's bytes, and the memory that its pixels may take.
struct EncodedPicture {
  const std::string &file, &name;  // for errors; `file` may be a scene's file that holds the picture
  std::span<const unsigned char> bytes;
  MemoryLimit& limit;

  [[nodiscard]] Unexpected error(const std::string& what) const;
  // Black texels. An error where the size is impossible or above the limit.
  [[nodiscard]] Expected<DecodedImage> black(std::uint64_t width, std::uint64_t height) const;
};

// What a decoding library fills: four bytes for each texel.
[[nodiscard]] std::span<unsigned char> bytes_of(DecodedImage& image);

[[nodiscard]] bool starts_with(std::span<const unsigned char> bytes, std::string_view magic);

}  // namespace pinocchio
