#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Which lights reach each pixel: `bits` (1, 2, 4 or 8) a pixel, packed low bits first, each row padded to
// whole bytes. Bit i of a pixel is mask slot i.
class MaskImage {
 public:
  MaskImage() = default;
  MaskImage(glm::ivec2 size, int bits) { resize(size, bits); }

  // Fewest bits that hold `lights` casting lights: 0, 1, 2, 4 or 8.
  [[nodiscard]] static int bits_for(int lights) {
    assert(lights <= 8);
    return lights <= 2 ? lights : lights <= 4 ? 4 : 8;
  }
  [[nodiscard]] static int row_bytes_for(int width, int bits) { return (width * bits + 7) / 8; }

  void resize(glm::ivec2 size, int bits) {
    size_ = size;
    bits_ = bits;
    row_bytes_ = row_bytes_for(size.x, bits);
    bytes_.assign(static_cast<std::size_t>(row_bytes_) * static_cast<std::size_t>(size.y), 0);
  }

  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] int bits() const { return bits_; }
  [[nodiscard]] int row_bytes() const { return row_bytes_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

  [[nodiscard]] unsigned get(int x, int y) const {
    if (bits_ == 0) return 0;
    return (bytes_[byte_of(x, y)] >> shift_of(x)) & ((1u << bits_) - 1u);
  }
  void set_bit(int x, int y, int slot) {
    bytes_[byte_of(x, y)] |= static_cast<std::uint8_t>(1u << (shift_of(x) + slot));
  }

  // All bits of the pixels from (x, y) on; x * bits is a multiple of 8, and they were 0.
  void set_row(int x, int y, std::span<const std::uint8_t> pixels) {
    if (bits_ == 0) return;
    std::uint8_t* row = bytes_.data() + byte_of(x, y);
    const auto a_byte = static_cast<std::size_t>(8 / bits_);
    for (std::size_t first = 0; first < pixels.size(); first += a_byte) {
      unsigned byte = 0;
      for (std::size_t i = std::min(first + a_byte, pixels.size()); i-- > first;)
        byte = byte << bits_ | pixels[i];
      *row++ |= static_cast<std::uint8_t>(byte);
    }
  }

  // The same in 8 x 8 pixels; x is a multiple of 8.
  void set_block(int x, int y, int slot) {
    // Pixels of 1, 2, 4 and 8 bits repeat within a byte.
    const unsigned every = bits_ == 1 ? 0xffu : bits_ == 2 ? 0x55u : bits_ == 4 ? 0x11u : 0x01u;
    for (int row = y; row < y + 8; ++row)
      for (int i = 0; i < bits_; ++i)
        bytes_[byte_of(x, row) + static_cast<std::size_t>(i)] |= static_cast<std::uint8_t>(every << slot);
  }

 private:
  [[nodiscard]] std::size_t byte_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(row_bytes_) +
           static_cast<std::size_t>(x * bits_ / 8);
  }
  [[nodiscard]] int shift_of(int x) const { return x * bits_ % 8; }

  glm::ivec2 size_{0, 0};
  int bits_ = 0;
  int row_bytes_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace pinocchio
