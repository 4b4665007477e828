// Environments as other programs write them; OpenEXR writes them here.
#include <ImfArray.h>
#include <ImfEnvmap.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "pinocchio/environment.h"
#include "pinocchio/exr.h"
#include "pinocchio/load.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

void write_rgba(const std::filesystem::path& file, const Imf::Header& header, Imf::RgbaChannels channels,
                const Imf::Array2D<Imf::Rgba>& pixels, int width, int height) {
  Imf::RgbaOutputFile out(file.c_str(), header, channels);
  out.setFrameBuffer(&pixels[0][0], 1, static_cast<std::size_t>(width));
  out.writePixels(height);
}

TEST(EnvironmentFile, CubeMapsAreReadByTheirDirections) {
  constexpr int kSide = 16;
  Imf::Header header(kSide, 6 * kSide);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  Imf::Array2D<Imf::Rgba> pixels(6 * kSide, kSide);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Imath::V2f in_face(static_cast<float>(x), static_cast<float>(y));
        const auto cube_face = static_cast<Imf::CubeMapFace>(face);
        const Imath::V3f d = Imf::CubeMap::direction(cube_face, header.dataWindow(), in_face).normalized();
        const Imath::V2f at = Imf::CubeMap::pixelPosition(cube_face, header.dataWindow(), in_face);
        pixels[static_cast<int>(at.y)][static_cast<int>(at.x)] = {1.0f + d.x, 1.0f + d.y, 1.0f + d.z};
      }
  write_rgba(own_file("cube.exr"), header, Imf::WRITE_RGB, pixels, kSide, 6 * kSide);
  Warnings warnings;
  const auto sky = load_environment(own_file("cube.exr"), nullptr, kUsualLoadLimit, &warnings);
  ASSERT_TRUE(sky) << sky.error().message();
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
  const Image<glm::vec3>& image = (*sky)->radiance();
  ASSERT_EQ(image.size(), glm::ivec2(4 * kSide, 2 * kSide));
  constexpr float kError = 0.02f;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(image.size());
      const float turn = glm::two_pi<float>() * (0.5f - uv.x), down = glm::pi<float>() * uv.y;
      const glm::vec3 d(std::sin(down) * std::sin(turn), std::cos(down), std::sin(down) * std::cos(turn));
      const glm::vec3 error = glm::abs(image.at(x, y) - (1.0f + d));
      ASSERT_LT(std::max({error.x, error.y, error.z}), kError) << x << " " << y;
    }
}

TEST(EnvironmentFile, CubeMapsOfOtherShapesAreErrors) {
  Imf::Header header(8, 24);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  Imf::Array2D<Imf::Rgba> pixels(24, 8);
  for (int i = 0; i < 24 * 8; ++i) (&pixels[0][0])[i] = {0.5f, 0.5f, 0.5f};
  write_rgba(own_file("odd.exr"), header, Imf::WRITE_RGB, pixels, 8, 24);
  const auto sky = load_environment(own_file("odd.exr"));
  ASSERT_FALSE(sky);
  EXPECT_NE(sky.error().message().find("six squares"), std::string::npos);
}

TEST(EnvironmentFile, LuminanceAndChromaAreColour) {
  constexpr int kWidth = 32, kHeight = 16;
  const Imf::Header header(kWidth, kHeight);
  Imf::Array2D<Imf::Rgba> pixels(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) pixels[y][x] = {0.75f, 0.5f, 0.25f};
  write_rgba(own_file("yc.exr"), header, Imf::WRITE_YC, pixels, kWidth, kHeight);
  const auto sky = load_environment(own_file("yc.exr"));
  ASSERT_TRUE(sky) << sky.error().message();
  ASSERT_EQ((*sky)->radiance().size(), glm::ivec2(kWidth, kHeight));
  constexpr float kError = 0.01f;
  for (const glm::vec3& c : (*sky)->radiance().pixels()) {
    const glm::vec3 error = glm::abs(c - glm::vec3(0.75f, 0.5f, 0.25f));
    ASSERT_LT(std::max({error.x, error.y, error.z}), kError) << c.x << " " << c.y << " " << c.z;
  }
}

TEST(EnvironmentFile, WhatIsNotFiniteIsRepairedAndSaid) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  ExrFile exr;
  exr.display_size = {8, 4};
  exr.data_window = {{0, 0}, exr.display_size};
  for (const char* name : {"R", "G", "B"})
    exr.channels.push_back({name, ExrChannel::Type::real, std::vector<float>(32, 0.5f), {}});
  exr.channels[0].values[3] = NAN;
  exr.channels[1].values[4] = kInfinity;
  exr.channels[2].values[4] = -kInfinity;
  exr.channels[2].values[9] = 40.5f;
  write_exr(own_file("holes.exr"), exr);
  Warnings warnings;
  const auto sky = load_environment(own_file("holes.exr"), nullptr, kUsualLoadLimit, &warnings);
  ASSERT_TRUE(sky) << sky.error().message();
  EXPECT_EQ((*sky)->radiance().at(3, 0), glm::vec3(0.0f, 0.5f, 0.5f));
  EXPECT_EQ((*sky)->radiance().at(4, 0), glm::vec3(0.5f, 40.5f, 0.0f));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("holes.exr: pixels hold NaN (1) or infinity (1); NaN is read as 0, "
                                       "infinity as the largest finite value, 40.5"),
            std::string::npos)
      << warnings[0].message();
}

TEST(EnvironmentFile, NegativeLightIsReadAsNoneAndSaid) {
  ExrFile exr;
  exr.display_size = {8, 4};
  exr.data_window = {{0, 0}, exr.display_size};
  for (const char* name : {"R", "G", "B"})
    exr.channels.push_back({name, ExrChannel::Type::real, std::vector<float>(32, 0.5f), {}});
  exr.channels[0].values[3] = -2.0f;
  write_exr(own_file("negative.exr"), exr);
  Warnings warnings;
  const auto sky = load_environment(own_file("negative.exr"), nullptr, kUsualLoadLimit, &warnings);
  ASSERT_TRUE(sky) << sky.error().message();
  EXPECT_EQ((*sky)->radiance().at(3, 0), glm::vec3(0.0f, 0.5f, 0.5f));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find(
                "negative.exr: holds negative light (1 pixel(s)); negative components are read as 0"),
            std::string::npos)
      << warnings[0].message();
}

TEST(EnvironmentFile, OtherShapesThanTwoToOneAreSaid) {
  ExrFile exr;
  exr.display_size = {8, 8};
  exr.data_window = {{0, 0}, exr.display_size};
  exr.channels.push_back({"Y", ExrChannel::Type::real, std::vector<float>(64, 0.5f), {}});
  write_exr(own_file("square.exr"), exr);
  Warnings warnings;
  ASSERT_TRUE(load_environment(own_file("square.exr"), nullptr, kUsualLoadLimit, &warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("is 8 x 8 pixels"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
