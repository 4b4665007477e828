// The filter of sampled light by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/denoise/gathered_light.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{83, 61};  // no multiple of a packet
constexpr glm::vec3 kAlbedo{0.5f, 0.4f, 0.3f};

using Picture = GatheredLight::Picture;

Workers& workers() {
  static Workers two(2);
  return two;
}

// A wall that faces the eye, under light that `light` gives for each pixel.
template <class Light>
Image<SampledPoint> wall(Light light, const glm::vec3& albedo = kAlbedo) {
  Image<SampledPoint> sample(kSize);
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      sample.at(x, y) = {.light = light(x, y) * albedo,
                         .albedo = albedo,
                         .normal = {0, 0, 1},
                         .distance = 5.0f,
                         .guide_albedo = albedo.g};
  return sample;
}

// Light of mean 1 that is 0 or 4.
auto noise(unsigned seed) {
  return
      [random = std::mt19937(seed)](int, int) mutable { return glm::vec3(random() % 4 == 0 ? 4.0f : 0.0f); };
}

void add_to(GatheredLight& gathered, const Image<SampledPoint>& sample, Picture picture, Isa isa,
            Workers& threads, Image<glm::vec3>& light) {
  const Image<SampledPoint> none;
  gathered.add({&sample, &none}, picture, isa, threads, light);
}

Image<glm::vec3> filtered(const Image<SampledPoint>& sample, Isa isa = default_isa()) {
  GatheredLight gathered;
  Image<glm::vec3> light;
  add_to(gathered, sample, Picture::filtered, isa, workers(), light);
  return light;
}

// Mean and standard deviation of red over pixels of a box.
struct Spread {
  double mean = 0.0, deviation = 0.0;
};
Spread spread(const Image<glm::vec3>& light, glm::ivec2 lo = {0, 0}, glm::ivec2 hi = kSize) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (int y = lo.y; y < hi.y; ++y)
    for (int x = lo.x; x < hi.x; ++x, n += 1.0) {
      const auto red = static_cast<double>(light.at(x, y).r);
      sum += red;
      squares += red * red;
    }
  return {sum / n, std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0))};
}

TEST(Denoise, EvenLightStaysAsItIs) {
  const Image<glm::vec3> light = filtered(wall([](int, int) { return glm::vec3(2.0f, 1.0f, 0.5f); }));
  const glm::vec3 expected = kAlbedo * glm::vec3(2.0f, 1.0f, 0.5f);
  for (const glm::vec3& pixel : light.pixels())
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-5f);
}

TEST(Denoise, NoiseIsTakenAwayAndTheLightKept) {
  const Image<SampledPoint> sample = wall(noise(1));
  const Spread after = spread(filtered(sample));
  EXPECT_NEAR(after.mean, 0.5, 0.03);
  EXPECT_LT(after.deviation, 0.06) << "before: " << 0.5 * std::sqrt(3.0);
}

// Noise that is as strong on both sides: the light of neither goes over an edge of the surfaces.
TEST(Denoise, EdgesOfSurfacesStaySharp) {
  enum Edge { normal, distance, albedo };
  for (const Edge edge : {normal, distance, albedo}) {
    Image<SampledPoint> sample = wall(noise(2));
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < 40; ++x) {
        SampledPoint& point = sample.at(x, y);
        if (edge == normal) point.normal = {0.8f, 0.0f, 0.6f};
        if (edge == distance) point.distance = 6.0f;
        if (edge == albedo) point.guide_albedo *= 0.25f;
        point.light = {};  // dark on this side
      }
    const Image<glm::vec3> light = filtered(sample);
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < 40; ++x)
        ASSERT_EQ(light.at(x, y), glm::vec3(0.0f)) << edge << " at " << x << ", " << y;
    EXPECT_NEAR(spread(light, {40, 0}, kSize).mean, 0.5, 0.04) << edge;
  }
}

// A surface that is seen at an angle is one surface.
TEST(Denoise, SlopesAreFiltered) {
  Image<SampledPoint> sample = wall(noise(3));
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      sample.at(x, y).distance = 5.0f + 0.3f * static_cast<float>(x) + 0.1f * static_cast<float>(y);
  EXPECT_LT(spread(filtered(sample)).deviation, 0.06);
}

// The texture is in the albedo, which the light is divided by.
TEST(Denoise, TexturesStaySharp) {
  Image<SampledPoint> sample = wall([](int, int) { return glm::vec3(1.0f); });
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const glm::vec3 albedo((x + y) % 2 == 0 ? 0.8f : 0.1f);
      sample.at(x, y).albedo = sample.at(x, y).light = albedo;
    }
  const Image<glm::vec3> light = filtered(sample);
  for (std::size_t i = 0; i < light.pixels().size(); ++i)
    ASSERT_NEAR(light[i].r, sample[i].albedo.r, 1e-5f * sample[i].albedo.r);
}

// The fall-off of a near lamp is in what it sends without shadows, which its light is divided by.
TEST(Denoise, ShadingByLampsStays) {
  Image<SampledPoint> sample = wall([](int, int) { return glm::vec3(0.0f); });
  std::mt19937 random(6);
  const auto falloff = [](int x) {
    const float off = 0.25f * static_cast<float>(x - 40);
    return 1.0f / (1.0f + off * off);
  };
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      SampledPoint& point = sample.at(x, y);
      point.lamp_albedo = glm::vec3(falloff(x));
      point.lamp_light = point.lamp_albedo * (random() % 2 == 0 ? 2.0f : 0.0f);
    }
  const Image<glm::vec3> light = filtered(sample);
  double squares = 0.0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      squares += std::pow(static_cast<double>(light.at(x, y).r / falloff(x)) - 1.0, 2);
  EXPECT_LT(std::sqrt(squares / (kSize.x * kSize.y)), 0.2) << "before: 1";
}

// The noise of other light does not blur an edge that the samples of a lamp agree about.
TEST(Denoise, ShadowsOfLampsStaySharpBesideNoise) {
  GatheredLight gathered;
  Image<glm::vec3> sum(kSize), light;
  for (unsigned k = 0; k < 4; ++k) {
    Image<SampledPoint> sample = wall(noise(20 + k));
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        sample.at(x, y).lamp_albedo = kAlbedo;
        sample.at(x, y).lamp_light = x < 40 ? glm::vec3(0.0f) : kAlbedo;
      }
    add_to(gathered, sample, k == 3 ? Picture::filtered : Picture::mean, default_isa(), workers(), light);
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum[i] += light[i];
  }
  const double dark = spread(sum, {34, 0}, {40, kSize.y}).mean / 4.0,
               lit = spread(sum, {40, 0}, {46, kSize.y}).mean / 4.0;
  EXPECT_NEAR(lit - dark, 0.5, 0.03);
}

// An edge of light, as of a shadow, that many samples agree about.
TEST(Denoise, CertainEdgesOfLightStaySharp) {
  const Image<SampledPoint> sample = wall([](int x, int) { return glm::vec3(x < 40 ? 0.2f : 1.0f); });
  GatheredLight gathered;
  Image<glm::vec3> sum(kSize), light;
  for (int k = 0; k < 8; ++k) {
    add_to(gathered, sample, k == 7 ? Picture::filtered : Picture::mean, default_isa(), workers(), light);
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum[i] += light[i];
  }
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      ASSERT_NEAR(sum.at(x, y).r / 8.0f, 0.5f * (x < 40 ? 0.2f : 1.0f), 1e-5f) << x << ", " << y;
}

TEST(Denoise, NoNumbersDoNoHarm) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    Image<SampledPoint> sample = wall([](int, int) { return glm::vec3(1.0f); });
    sample.at(30, 30).light = glm::vec3(bad);
    sample.at(50, 30).normal = glm::vec3(bad);
    sample.at(10, 30).distance = bad;
    const Image<glm::vec3> light = filtered(sample);
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x)
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(std::isfinite(light.at(x, y)[c])) << x << ", " << y;
          ASSERT_LE(light.at(x, y)[c], 0.51f) << x << ", " << y;
        }
    EXPECT_NEAR(light.at(20, 50).r, 0.5f, 0.01f);
  }
}

// Nothing is seen in half of the picture: no light goes there, and none is lost.
TEST(Denoise, WhatSeesNothingIsLeftAlone) {
  Image<SampledPoint> sample = wall(noise(4));
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < 40; ++x) sample.at(x, y) = {};
  const Image<glm::vec3> light = filtered(sample);
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < 40; ++x) ASSERT_EQ(light.at(x, y), glm::vec3(0.0f));
  EXPECT_NEAR(spread(light, {40, 0}, kSize).mean, 0.5, 0.04);
}

// The mean of all pictures shows the filtered mean of all samples, whatever was shown on the way.
TEST(Denoise, TheMeanOfThePicturesIsTheFilteredMean) {
  const std::array<std::array<Picture, 5>, 3> ways{
      {{Picture::mean, Picture::mean, Picture::mean, Picture::mean, Picture::filtered},
       {Picture::filtered, Picture::filtered, Picture::kept, Picture::filtered, Picture::filtered},
       {Picture::filtered, Picture::kept, Picture::kept, Picture::mean, Picture::filtered}}};
  Image<glm::vec3> first;
  for (const auto& way : ways) {
    GatheredLight gathered;
    Image<glm::vec3> sum(kSize), light;
    for (std::size_t k = 0; k < way.size(); ++k) {
      add_to(gathered, wall(noise(10 + static_cast<unsigned>(k))), way[k], default_isa(), workers(), light);
      for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum[i] += light[i];
      if (way[k] == Picture::kept && k == 1) {
        for (std::size_t i = 0; i < sum.pixels().size(); ++i)
          ASSERT_NEAR(0.5f * sum[i].r, sum[i].r - light[i].r, 1e-4f) << "what was shown is kept";
      }
    }
    if (first.empty()) first = sum;
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) ASSERT_NEAR(sum[i].r, first[i].r, 2e-4f);
  }
  EXPECT_NEAR(spread(first).mean / 5.0, 0.5, 0.02);
}

// With more samples less is smoothed: the filtered picture goes to the samples' mean.
TEST(Denoise, ItsInfluenceVanishes) {
  const auto shadow = [](unsigned seed) {
    return [random = std::mt19937(seed)](int x, int) mutable {
      const float soft =
          0.5f + 0.5f * std::sin(0.5f * static_cast<float>(x));  // finer than the filter is wide
      return glm::vec3(std::uniform_real_distribution<float>(0.0f, 2.0f)(random) * soft);
    };
  };
  const auto error = [&](int samples) {
    GatheredLight gathered;
    Image<glm::vec3> sum(kSize), light;
    for (int k = 0; k < samples; ++k) {
      add_to(gathered, wall(shadow(100 + static_cast<unsigned>(k))),
             k + 1 == samples ? Picture::filtered : Picture::mean, default_isa(), workers(), light);
      for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum[i] += light[i];
    }
    double squares = 0.0;
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const float truth = 0.5f * (0.5f + 0.5f * std::sin(0.5f * static_cast<float>(x)));
        const auto off = static_cast<double>(sum.at(x, y).r / static_cast<float>(samples) - truth);
        squares += off * off;
      }
    return std::sqrt(squares / (kSize.x * kSize.y));
  };
  const double few = error(4), many = error(64);
  EXPECT_LT(many, 0.4 * few);
}

TEST(Denoise, TheSameBitsOnAllProcessorsAndThreads) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(0.0f, 1.0f);
  Image<SampledPoint> sample = wall(noise(5));
  for (SampledPoint& point : sample.pixels()) {
    point.normal = glm::normalize(glm::vec3(0.2f * number(random), 0.2f * number(random), 1.0f));
    point.distance += 0.05f * number(random);
    point.albedo *= 0.7f + 0.3f * number(random);
    if (number(random) < 0.05f) point = {};
  }
  const Image<glm::vec3> expected = filtered(sample, Isa::scalar);
  for (const Isa isa : supported_isas()) {
    const Image<glm::vec3> light = filtered(sample, isa);
    EXPECT_EQ(std::memcmp(light.pixels().data(), expected.pixels().data(), expected.pixels().size_bytes()), 0)
        << isa_name(isa);
  }
  Workers one(1);
  GatheredLight gathered;
  Image<glm::vec3> light;
  add_to(gathered, sample, Picture::filtered, default_isa(), one, light);
  EXPECT_EQ(std::memcmp(light.pixels().data(), expected.pixels().data(), expected.pixels().size_bytes()), 0);
}

TEST(Denoise, PicturesOfAnySize) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 40}, {40, 1}, {17, 3}}) {
    Image<SampledPoint> sample(size,
                               {.light = {1, 1, 1}, .albedo = {1, 1, 1}, .normal = {0, 0, 1}, .distance = 1});
    const Image<glm::vec3> light = filtered(sample);
    for (const glm::vec3& pixel : light.pixels()) EXPECT_NEAR(pixel.g, 1.0f, 1e-5f);
  }
}

}  // namespace
}  // namespace pinocchio
