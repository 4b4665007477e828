#include "pinocchio/image.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace pinocchio {
namespace {

template <class T>
std::uintptr_t place_of(const Image<T>& image) {
  return reinterpret_cast<std::uintptr_t>(image.pixels().data());
}

TEST(Image, LargeOnesBeginOnALargePage) {
  constexpr std::uintptr_t kLargePage = std::uintptr_t{1} << 21;
  EXPECT_EQ(place_of(Image<glm::vec4>({800, 600})) % kLargePage, 0u);
  EXPECT_EQ(place_of(Image<std::uint32_t>({800, 600})) % kLargePage, 0u);  // 1.83 MiB: nearly one
}

// Fresh pages have to be cleared by the system, which takes longer than drawing a small mesh.
TEST(Image, MemoryOfAFrameIsTheNextFramesToo) {
  std::uintptr_t before = 0;
  {
    const Image<glm::vec4> image({800, 600}, glm::vec4(1.0f));
    before = place_of(image);
  }
  const Image<glm::vec4> image({800, 600});
  EXPECT_EQ(place_of(image), before);
  for (const glm::vec4& pixel : image.pixels()) ASSERT_EQ(pixel, glm::vec4(0.0f));
}

TEST(Image, SmallOnesBeginOnACacheLine) {
  for (int width = 1; width < 70; ++width) EXPECT_EQ(place_of(Image<std::uint8_t>({width, 3})) % 64, 0u);
}

TEST(Image, HoldsItsValueToTheLastPixel) {
  for (const glm::ivec2 size :
       {glm::ivec2(1, 1), glm::ivec2(724, 724), glm::ivec2(725, 724), glm::ivec2(1024, 512)}) {
    const Image<std::uint32_t> image(size, 7u);
    for (const std::uint32_t pixel : image.pixels()) ASSERT_EQ(pixel, 7u);
  }
}

}  // namespace
}  // namespace pinocchio
