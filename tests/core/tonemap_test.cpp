#include "core/image/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/image/png.h"

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

TEST(Tonemap, ClampsWhatNoScreenShows) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(linear_to_srgb8(-1.0f), 0);
  EXPECT_EQ(linear_to_srgb8(-kInf), 0);
  EXPECT_EQ(linear_to_srgb8(7.0f), 255);
  EXPECT_EQ(linear_to_srgb8(kInf), 255);
  EXPECT_EQ(linear_to_srgb8(std::nanf("")), 0);
}

TEST(Tonemap, ExposureIsInStops) {
  const Image<glm::vec4> quarter({1, 1}, glm::vec4(0.25f));
  EXPECT_EQ(preview(quarter, 1.0f)[0].x, linear_to_srgb8(0.5f));
  EXPECT_EQ(preview(quarter, -2.0f)[0].x, linear_to_srgb8(0.0625f));
}

}  // namespace
}  // namespace pinocchio
