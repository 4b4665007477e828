// Texts of backgrounds and of the shadow catcher.
#include "pinocchio/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/image/tonemap.h"
#include "core/scene/sky/lat_long.h"
#include "pinocchio/scene.h"
#include "pinocchio/shadow_catcher.h"
#include "pinocchio/studio.h"

namespace pinocchio {
namespace {

using Kind = Background::Kind;

TEST(Background, KindsHaveNames) {
  EXPECT_EQ(parse_background("environment"), Background{});
  EXPECT_EQ(parse_background("studio"), Background{Kind::studio});
  EXPECT_EQ(parse_background("transparent"), Background{Kind::transparent});
  for (const char* text : {"environment", "studio", "transparent"})
    EXPECT_EQ(to_text(*parse_background(text)), text);
}

TEST(Background, ColoursAreSrgbInHexAndByNameAndLinearInNumbers) {
  const auto color = [](const char* text) {
    const std::optional<Background> background = parse_background(text);
    EXPECT_TRUE(background && background->kind == Kind::color) << text;
    return background ? background->color : glm::vec3(-1.0f);
  };
  EXPECT_EQ(color("#ff8000"), glm::vec3(1.0f, srgb8_to_linear(0x80), 0.0f));
  EXPECT_EQ(color("#FF8000"), color("#ff8000"));
  EXPECT_EQ(color("white"), glm::vec3(1.0f));
  EXPECT_EQ(color("black"), glm::vec3(0.0f));
  EXPECT_EQ(color("gray"), glm::vec3(srgb8_to_linear(0x80)));
  EXPECT_EQ(color("grey"), color("#808080"));
  EXPECT_EQ(color("orange"), color("#ffa500"));
  EXPECT_EQ(color("0.18,0.5,2"), glm::vec3(0.18f, 0.5f, 2.0f));
  EXPECT_EQ(color("1e-3,0,65504"), glm::vec3(1e-3f, 0.0f, 65504.0f));
}

TEST(Background, OtherTextsAreRefused) {
  for (const char* text :
       {"", "Transparent", "#fff", "#ff80000", "#ff80gg", "#+f8000", "ff8000", "1,2", "1,2,3,4", "1,2,", ",,",
        "-1,0,0", "nan,0,0", "inf,0,0", "70000,0,0", "0.5", " white", "1, 2, 3"})
    EXPECT_FALSE(parse_background(text)) << text;
}

TEST(Background, EveryColourGoesThereAndBack) {
  for (const char* text : {"#123456", "0.1,0.2,0.3", "white", "1e-07,3,65504"}) {
    const Background background = *parse_background(text);
    EXPECT_EQ(parse_background(to_text(background)), background) << text;
  }
}

TEST(Background, BackdropIsTheScenesEnvironmentOrTheStudios) {
  Scene scene;
  EXPECT_EQ(backdrop_of(scene, {}).picture, nullptr);
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({2, 1}, glm::vec3(1.0f)));
  scene.environment_rotation_deg = 20.0f;
  scene.environment_strength = 3.0f;
  const Backdrop own = backdrop_of(scene, {});
  EXPECT_EQ(own.picture, scene.environment);
  EXPECT_EQ(own.rotation_deg, 20.0f);
  EXPECT_EQ(own.strength, 3.0f);
  const Backdrop studio = backdrop_of(scene, {Kind::studio});
  EXPECT_EQ(studio.picture, studio_sky());
  EXPECT_EQ(studio.strength, 1.0f);
  EXPECT_EQ(backdrop_of(scene, {Kind::transparent}).picture, nullptr);
  EXPECT_EQ(backdrop_of(scene, {Kind::color, glm::vec3(1.0f)}).picture, nullptr);
}

constexpr double kPi = 3.14159265358979;

// A sky of that size, black but for one texel.
std::shared_ptr<const Environment> sky_with_a_sun(glm::ivec2 size, glm::ivec2 sun) {
  Image<glm::vec3> picture(size, glm::vec3(0.0f));
  picture.at(sun.x, sun.y) = {3.0f, 2.0f, 1.0f};
  return std::make_shared<const Environment>(std::move(picture));
}

// The light of a sky, and the mean square of its angle from the mean direction, of green.
struct Moments {
  double light = 0.0, square = 0.0;
};
Moments moments_of(const Image<glm::vec3>& texels) {
  const Image<glm::vec3> sky = reduced(texels, {720, 360});  // as it is shown: interpolated
  Moments m;
  std::vector<std::pair<glm::dvec3, double>> parts;
  glm::dvec3 mean(0.0);
  for (int y = 0; y < sky.height(); ++y) {
    const double down = kPi * (y + 0.5) / sky.height();
    const double area =
        (std::cos(kPi * y / sky.height()) - std::cos(kPi * (y + 1) / sky.height())) * 2.0 * kPi / sky.width();
    for (int x = 0; x < sky.width(); ++x) {
      const double turn = 2.0 * kPi * (x + 0.5) / sky.width();
      const glm::dvec3 direction(std::sin(down) * std::sin(turn), std::cos(down),
                                 std::sin(down) * std::cos(turn));
      parts.emplace_back(direction, area * static_cast<double>(sky.at(x, y).g));
      mean += parts.back().second * direction;
      m.light += parts.back().second;
    }
  }
  mean = glm::normalize(mean);
  for (const auto& [direction, light] : parts)
    m.square += light * std::pow(std::acos(std::clamp(glm::dot(direction, mean), -1.0, 1.0)), 2.0) / m.light;
  return m;
}

TEST(BackgroundBlur, SpreadsLightByItsDeviationAtEveryHeight) {
  for (const int row : {0, 20, 128, 200})
    for (const float blur : {0.1f, 0.25f, 0.6f}) {
      Scene scene;
      scene.environment = sky_with_a_sun({512, 256}, {300, row});
      const double light = 2.0 * kPi * (std::cos(kPi * row / 256.0) - std::cos(kPi * (row + 1) / 256.0)) *
                           2.0 / 512.0;  // green, of the texel
      const Backdrop behind = backdrop_of(scene, {}, blur);
      const Moments soft = moments_of(behind.picture->radiance());
      const double deviation = glm::radians(static_cast<double>(kWidestBlur_deg * blur));
      EXPECT_NEAR(soft.light / light, 1.0, 0.02) << row << " " << blur;
      EXPECT_NEAR(std::sqrt(soft.square / 2.0) / deviation, 1.0, 0.03) << row << " " << blur;
    }
}

TEST(BackgroundBlur, AnEvenSkyStaysEven) {
  Scene scene;
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({5, 3}, glm::vec3(0.25f)));
  for (const float blur : {0.01f, 0.3f, 1.0f}) {
    const Image<glm::vec3>& soft = backdrop_of(scene, {}, blur).picture->radiance();
    for (const glm::vec3& texel : soft.pixels()) ASSERT_NEAR(texel.g, 0.25f, 1e-5f) << blur;
    EXPECT_LE(soft.width(), 1024);
  }
}

TEST(BackgroundBlur, PicturesAreKeptAndTurnedAsTheSkyIs) {
  Scene scene;
  scene.environment = sky_with_a_sun({64, 32}, {40, 9});
  scene.environment_rotation_deg = 20.0f;
  EXPECT_EQ(backdrop_of(scene, {}, 0.0f).picture, scene.environment);
  const Backdrop soft = backdrop_of(scene, {}, 0.5f);
  EXPECT_NE(soft.picture, scene.environment);
  EXPECT_EQ(soft.rotation_deg, 20.0f);
  EXPECT_EQ(backdrop_of(scene, {}, 0.5f).picture, soft.picture);
  EXPECT_NE(backdrop_of(scene, {}, 0.25f).picture, soft.picture);
  EXPECT_NE(backdrop_of(scene, {Kind::studio}, 0.5f).picture, studio_sky());
  EXPECT_EQ(backdrop_of(scene, {Kind::transparent}, 0.5f).picture, nullptr);
  EXPECT_EQ(backdrop_of(scene, {Kind::color}, 0.5f).picture, nullptr);
}

TEST(ShadowCatcher, TextsGoThereAndBack) {
  using Catcher = ShadowCatcher::Kind;
  EXPECT_EQ(parse_shadow_catcher("off"), ShadowCatcher{});
  EXPECT_EQ(parse_shadow_catcher("lowest"), ShadowCatcher{Catcher::lowest});
  EXPECT_EQ(parse_shadow_catcher("-0.25"), (ShadowCatcher{Catcher::at, -0.25f}));
  EXPECT_EQ(parse_shadow_catcher("0"), (ShadowCatcher{Catcher::at, 0.0f}));
  for (const char* text : {"off", "lowest", "-0.25", "1e-07"})
    EXPECT_EQ(to_text(*parse_shadow_catcher(text)), text);
  for (const char* text : {"", "low", "nan", "inf", "2e9", "1,2", " 1", "1m"})
    EXPECT_FALSE(parse_shadow_catcher(text)) << text;
}

}  // namespace
}  // namespace pinocchio
