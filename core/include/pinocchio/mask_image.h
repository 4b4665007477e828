#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/glm_layout.h"

namespace pinocchio {

// The lights that reach each pixel: `bits` (1, 2, 4, 8, 16, 32 or a multiple of 64) for each pixel, packed
// from the low bits and bytes up, each row padded to whole bytes. Bit i of a pixel is mask slot i.
class MaskImage {
 public:
  MaskImage() = default;
  MaskImage(glm::ivec2 size, int bits) { resize(size, bits); }

  // The fewest bits that hold `lights` casting lights.
  [[nodiscard]] static int bits_for(int lights) {
    if (lights > 32) return (lights + 63) / 64 * 64;
    return lights == 0 ? 0 : as_int(std::bit_ceil(static_cast<unsigned>(lights)));
  }
  // The bytes of a pixel that hold its bits: 1, 2, 4 or a multiple of 8.
  [[nodiscard]] static std::size_t bytes_for(std::size_t lights) {
    return as_size(std::max(bits_for(as_int(lights)) / 8, 1));
  }
  [[nodiscard]] static int row_bytes_for(int width, int bits) { return (width * bits + 7) / 8; }

  void resize(glm::ivec2 size, int bits) {
    size_ = size;
    bits_ = bits;
    row_bytes_ = row_bytes_for(size.x, bits);
    bytes_.assign(as_size(row_bytes_) * as_size(size.y), 0);
  }

  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] int bits() const { return bits_; }
  [[nodiscard]] int row_bytes() const { return row_bytes_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

  // The 32 slots from `first` on, a multiple of 32: slot first + i is bit i. Slots beyond bits() are 0.
  [[nodiscard]] unsigned get(int x, int y, int first = 0) const {
    if (bits_ == 0 || first >= std::max(bits_, 8)) return 0;
    if (bits_ < 8) return bytes_[byte_of(x, y)] >> shift_of(x) & ((1u << bits_) - 1u);
    unsigned slots = 0;
    for (int i = std::min(bits_ - first, 32) / 8; i-- > 0;)
      slots = slots << 8 | bytes_[byte_of(x, y) + as_size(first / 8 + i)];
    return slots;
  }
  void set_bit(int x, int y, int slot) {
    const int bit = shift_of(x) + slot;
    bytes_[byte_of(x, y) + as_size(bit / 8)] |= static_cast<std::uint8_t>(1u << bit % 8);
  }

  // Copies `count` pixels from (x, y) on, `bytes` to each: slot i is bit i % 8 of byte i / 8. Slots that the
  // mask does not have are 0, slots beyond `bytes` are left out.
  void copy_row(int x, int y, std::size_t count, std::size_t bytes, std::uint8_t* to) const {
    const std::size_t own = as_size(bits_) / 8;
    if (own == bytes) {
      std::memcpy(to, bytes_.data() + byte_of(x, y), count * bytes);
      return;
    }
    std::fill_n(to, count * bytes, std::uint8_t{0});
    for (std::size_t i = 0; i < count; ++i) {
      const int at = x + as_int(i);
      if (bits_ < 8)
        to[i * bytes] = static_cast<std::uint8_t>(get(at, y));
      else
        std::memcpy(to + i * bytes, bytes_.data() + byte_of(at, y), std::min(own, bytes));
    }
  }

  // Sets the slots 8 * byte to 8 * byte + 7 of the pixels from (x, y) on. They must be 0 before, and x * bits
  // a multiple of 8.
  void set_row(int x, int y, std::span<const std::uint8_t> pixels, int byte = 0) {
    if (bits_ == 0) return;
    std::uint8_t* row = bytes_.data() + byte_of(x, y);
    if (bits_ > 8) {
      row += byte;
      for (std::size_t i = 0; i < pixels.size(); ++i) row[i * as_size(bits_ / 8)] = pixels[i];
      return;
    }
    for (std::size_t first = 0, at = 0; first < pixels.size(); first += 8) {
      const std::size_t count = std::min<std::size_t>(pixels.size() - first, 8);
      std::uint64_t packed = 0;
      if (count == 8 && std::endian::native == std::endian::little)
        std::memcpy(&packed, &pixels[first], 8);
      else
        for (std::size_t i = first + count; i-- > first;) packed = packed << 8 | pixels[i];
      if (bits_ == 1) {  // byte i, times 2^(56 - 7 i), puts its bit at 56 + i, and no two sums meet
        row[at++] = static_cast<std::uint8_t>(packed * 0x0102040810204080u >> 56);
        continue;
      }
      // 8 pixels of 8 bits become 4 of 16, 2 of 32, and one of 64, each with so many used bits.
      for (int width = 8, used = bits_; width < 64; width *= 2, used *= 2)
        packed = (packed | packed >> (width - used)) & lowest_bits(used * 2, width * 2);
      for (std::size_t bytes = (count * as_size(bits_) + 7) / 8; bytes-- > 0; packed >>= 8)
        row[at++] = static_cast<std::uint8_t>(packed);
    }
  }

 private:
  [[nodiscard]] std::size_t byte_of(int x, int y) const {
    return as_size(y) * as_size(row_bytes_) + as_size(x * bits_ / 8);
  }
  // A word of fields of `width` bits, each with its lowest `used` bits set.
  [[nodiscard]] static std::uint64_t lowest_bits(int used, int width) {
    const std::uint64_t field = used == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << used) - 1;
    return width == 64 ? field : width == 32 ? field * 0x100000001u : field * 0x1000100010001u;
  }
  [[nodiscard]] int shift_of(int x) const { return x * bits_ % 8; }

  glm::ivec2 size_{0, 0};
  int bits_ = 0;
  int row_bytes_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace pinocchio
