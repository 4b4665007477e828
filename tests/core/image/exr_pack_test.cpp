#include "core/image/codecs/exr_pack.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <random>

namespace pinocchio {
namespace {

// As ImfZip.cpp's: differences summed up, the two halves as even and odd bytes.
std::vector<std::byte> unpacked(std::span<const std::byte> packed, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor{
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor};
  std::vector<unsigned char> bytes(size);
  std::size_t got = 0;
  EXPECT_EQ(
      libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), bytes.data(), size, &got),
      LIBDEFLATE_SUCCESS);
  EXPECT_EQ(got, size);
  for (std::size_t i = 1; i < size; ++i) bytes[i] = static_cast<unsigned char>(bytes[i] + bytes[i - 1] - 128);
  std::vector<std::byte> lines(size);
  for (std::size_t i = 0; i < size; ++i) lines[i] = std::byte{bytes[i / 2 + (i % 2) * ((size + 1) / 2)]};
  return lines;
}

TEST(ExrPack, WhatIsPackedIsReadAgain) {
  std::mt19937 random(1);
  const std::function<unsigned(std::size_t)> kinds[] = {
      [](std::size_t) { return 7u; },
      [](std::size_t i) { return static_cast<unsigned>(i / 2); },
      [](std::size_t i) {
        return static_cast<unsigned>(128.0 + 120.0 * std::sin(1e-3 * static_cast<double>(i)));
      },
      [&](std::size_t) { return random() & 3u; },
      [&](std::size_t i) { return i % 1000 < 500 ? 0u : random(); },
      [&](std::size_t) { return random(); },
  };
  std::vector<std::size_t> sizes;
  for (std::size_t size = 1; size < 100; ++size) sizes.push_back(size);
  for (const std::size_t size : {1000, 4095, 32769, 65536, 262144, 640001, 3000000}) sizes.push_back(size);
  for (const bool reproducible : {true, false})
    for (const auto& kind : kinds)
      for (const std::size_t size : sizes) {
        std::vector<std::byte> lines(size);
        for (std::size_t i = 0; i < size; ++i) lines[i] = std::byte{static_cast<unsigned char>(kind(i))};
        const std::vector<std::byte> packed = pack_zip(lines, reproducible);
        ASSERT_LE(packed.size(), size);
        ASSERT_EQ(packed.size() == size ? packed : unpacked(packed, size), lines)
            << "kind " << &kind - kinds << ", " << size << " bytes, reproducible " << reproducible;
      }
}

TEST(ExrPack, NoiseStaysAsItIsAndTheRestShrinks) {
  std::mt19937 random(1);
  std::vector<std::byte> noise(100'000), ramp(100'000);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise[i] = std::byte{static_cast<unsigned char>(random())};
    ramp[i] = std::byte{static_cast<unsigned char>(i / 2)};
  }
  for (const bool reproducible : {true, false}) {
    EXPECT_EQ(pack_zip(noise, reproducible), noise);
    EXPECT_LT(pack_zip(ramp, reproducible).size(), ramp.size() / 50);
    EXPECT_TRUE(pack_zip({}, reproducible).empty());
  }
}

}  // namespace
}  // namespace pinocchio
