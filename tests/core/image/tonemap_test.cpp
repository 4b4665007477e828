#include "core/image/tonemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pinocchio {
namespace {

TEST(Tonemap, FollowsTheSrgbCurveBothWays) {
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    EXPECT_EQ(linear_to_srgb8(srgb8_to_linear(byte)), byte);
  }
  EXPECT_NEAR(srgb8_to_linear(188), 0.5029f, 1e-4f);
  EXPECT_NEAR(linear_to_srgb(0.5f), 0.735357f, 1e-5f);
}

TEST(Tonemap, RoundsToTheNearestByte) {
  // Between two neighbours on the curve, the byte changes half way.
  for (int i = 0; i < 255; ++i) {
    const double c = (i + 0.5) / 255.0;
    const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    EXPECT_EQ(linear_to_srgb8(static_cast<float>(linear * 0.9999)), i);
    EXPECT_EQ(linear_to_srgb8(static_cast<float>(linear * 1.0001)), i + 1);
  }
}

double by_libm(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(Tonemap, LinearValuesAreWithinHalfAUnitOfLibm) {
  for (int i = 1; i < 256; ++i) {
    const double exact = by_libm(i / 255.0);
    const double unit = std::ldexp(1.0, std::ilogb(exact) - 23);
    EXPECT_LE(std::abs(static_cast<double>(srgb8_to_linear(static_cast<std::uint8_t>(i))) - exact),
              0.5001 * unit)
        << i;
  }
}

// Every float from 0 to 1 has the byte of libm's nearest: at each change of byte all neighbours, a sample
// between.
TEST(Tonemap, BytesChangeWhereLibmsDo) {
  int byte = 0;
  std::uint32_t wrong = 0;
  const auto expect = [&](float value) {
    while (byte < 255 && static_cast<double>(value) >= by_libm((byte + 0.5) / 255.0)) ++byte;
    wrong += linear_to_srgb8(value) == byte ? 0 : 1;
  };
  for (int next = 1; next <= 256; ++next) {
    const float change = next < 256 ? static_cast<float>(by_libm((next - 0.5) / 255.0)) : 1.0f;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(change);
    const std::uint32_t before =
        next > 1 ? std::bit_cast<std::uint32_t>(static_cast<float>(by_libm((next - 1.5) / 255.0))) + 64 : 1u;
    const std::uint32_t step = std::max((bits - before) / 2000, 1u);
    for (std::uint32_t b = before; b < bits - 64; b += step) expect(std::bit_cast<float>(b));
    for (std::uint32_t b = bits - 64; b < bits + 64 && b < 0x3f800000u; ++b) expect(std::bit_cast<float>(b));
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(Tonemap, ClampsWhatNoScreenShows) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(linear_to_srgb8(-1.0f), 0);
  EXPECT_EQ(linear_to_srgb8(-kInfinite), 0);
  EXPECT_EQ(linear_to_srgb8(7.0f), 255);
  EXPECT_EQ(linear_to_srgb8(kInfinite), 255);
  EXPECT_EQ(linear_to_srgb8(std::nanf("")), 0);
}

TEST(Tonemap, ExposureIsInStops) {
  const Image<glm::vec4> quarter({1, 1}, glm::vec4(0.25f));
  EXPECT_EQ(preview(quarter, 1.0f)[0].x, linear_to_srgb8(0.5f));
  EXPECT_EQ(preview(quarter, -2.0f)[0].x, linear_to_srgb8(0.0625f));
}

TEST(Tonemap, CurvesBringAllLightIntoWhatAScreenShows) {
  for (const ToneMap curve : {ToneMap::clip, ToneMap::reinhard, ToneMap::aces, ToneMap::neutral}) {
    float before = -1.0f;
    for (float light = 0.0f; light < 1e5f; light = 1.3f * light + 0.001f) {
      const float shown = tone_mapped(glm::vec3(light), curve).x;
      EXPECT_TRUE(shown >= before && shown <= 1.0f) << light;
      before = shown;
    }
    EXPECT_EQ(tone_mapped(glm::vec3(-1.0f), curve), glm::vec3(0.0f));
    EXPECT_FALSE(std::isnan(tone_mapped(glm::vec3(std::numeric_limits<float>::infinity()), curve).x));
  }
  EXPECT_EQ(tone_mapped(glm::vec3(0.3f, 1.0f, 7.0f), ToneMap::clip), glm::vec3(0.3f, 1.0f, 1.0f));
  EXPECT_FLOAT_EQ(tone_mapped(glm::vec3(3.0f), ToneMap::reinhard).x, 0.75f);
  EXPECT_NEAR(tone_mapped(glm::vec3(1.0f), ToneMap::aces).x, 0.8038f, 1e-4f);
}

// By the specification's formulas, worked out by hand.
TEST(Tonemap, NeutralKeepsColoursAndFadesHighlightsToWhite) {
  const glm::vec3 shown = tone_mapped(glm::vec3(0.5f, 0.2f, 0.1f), ToneMap::neutral);
  EXPECT_NEAR(shown.x, 0.46f, 1e-6f);
  EXPECT_NEAR(shown.y, 0.16f, 1e-6f);
  EXPECT_NEAR(shown.z, 0.06f, 1e-6f);
  EXPECT_NEAR(tone_mapped(glm::vec3(0.04f), ToneMap::neutral).x, 0.01f, 1e-6f);      // 6.25 x^2
  EXPECT_NEAR(tone_mapped(glm::vec3(1.04f), ToneMap::neutral).x, 0.88f, 1e-6f);      // 1 - 0.24^2 / 0.48
  const glm::vec3 red = tone_mapped(glm::vec3(4.0f, 0.0f, 0.0f), ToneMap::neutral);  // peak 4
  const float peak = 1.0f - 0.0576f / 3.48f, white = 1.0f - 1.0f / (0.15f * (4.0f - peak) + 1.0f);
  EXPECT_NEAR(red.x, peak, 1e-5f);
  EXPECT_NEAR(red.y, white * peak, 1e-5f);
}

TEST(Tonemap, AlphaIsStraightInPreviews) {
  Image<glm::vec4> half({2, 1});
  half[0] = glm::vec4(0.25f, 0.0f, 0.0f, 0.5f);
  const Image<glm::u8vec4> shown = preview_with_alpha(half, 0.0f, ToneMap::clip);
  EXPECT_EQ(shown[0], glm::u8vec4(linear_to_srgb8(0.5f), 0, 0, 128));
  EXPECT_EQ(shown[1], glm::u8vec4(0));
}

}  // namespace
}  // namespace pinocchio
