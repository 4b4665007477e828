#include "core/image/light_histogram.h"

#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>
#include <limits>
#include <numeric>

namespace pinocchio {
namespace {

LightHistogram histogram_of(const std::vector<glm::vec3>& pixels) {
  std::vector<LightHistogram::Sample> samples;
  for (const glm::vec3& c : pixels)
    samples.push_back({glm::packHalf1x16(glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f))),
                       glm::packHalf1x16(std::max({c.r, c.g, c.b}))});
  return LightHistogram(samples);
}

TEST(LightHistogram, EachPixelIsInTheBinOfItsStop) {
  const LightHistogram light =
      histogram_of({glm::vec3(0.0f), glm::vec3(0.25f), glm::vec3(0.3f), glm::vec3(1.5f), glm::vec3(1e6f)});
  // One bin a stop, from 2^-4 to 2^4.
  EXPECT_EQ(light.by_luminance(-4.0f, 4.0f, 8), (std::vector<float>{1, 0, 2, 0, 1, 0, 0, 1}));
  EXPECT_EQ(light.pixels(), 5u);
}

// As bytes have it: counted here from each pixel by itself.
TEST(LightHistogram, WhatIsClippedIsWhatTheBytesSay) {
  std::vector<glm::vec3> pixels;
  for (int i = 0; i < 4000; ++i)
    pixels.emplace_back(0.0007f * static_cast<float>(i), 0.0f, 0.00001f * static_cast<float>(i % 40));
  const LightHistogram light = histogram_of(pixels);
  for (const ToneMap curve : {ToneMap::clip, ToneMap::reinhard, ToneMap::aces})
    for (const float ev : {-3.0f, 0.0f, 2.5f}) {
      std::size_t white = 0, black = 0;
      for (const glm::vec3& pixel : pixels) {
        const float brightest = glm::unpackHalf1x16(glm::packHalf1x16(std::max({pixel.r, pixel.g, pixel.b})));
        const auto byte = linear_to_srgb8(tone_mapped(glm::vec3(brightest * std::exp2(ev)), curve).x);
        white += byte == 255;
        black += byte == 0;
      }
      EXPECT_EQ(light.shown_white(ev, curve), white) << ev;
      EXPECT_EQ(light.shown_black(ev, curve), black) << ev;
    }
}

TEST(LightHistogram, WhatIsNoLightIsBlack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const LightHistogram light =
      histogram_of({glm::vec3(nan), glm::vec3(-1.0f), glm::vec3(std::numeric_limits<float>::infinity())});
  EXPECT_EQ(light.shown_black(0.0f, ToneMap::clip), 2u);
  EXPECT_EQ(light.shown_white(0.0f, ToneMap::clip), 1u);
}

}  // namespace
}  // namespace pinocchio
