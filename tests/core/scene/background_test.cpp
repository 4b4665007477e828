// Texts of backgrounds and of the shadow catcher.
#include "pinocchio/background.h"

#include <gtest/gtest.h>

#include "core/image/tonemap.h"
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
