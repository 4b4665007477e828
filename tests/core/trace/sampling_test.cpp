// The sequences of samples: Sobol's points are Sobol's however they are scrambled, every width of lanes has
// the same bits, and the error of a mean falls as fast as it should.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/aligned_vector.h"
#include "core/shade/shared.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr int kAllSequences[] = {shared::kSequenceSobol, shared::kSequenceBlueNoise, shared::kSequenceRandom,
                                 shared::kSequenceZOrder};

glm::vec2 sample_of(const shared::Sampling& sampling, const glm::uvec2& pixel, std::uint32_t dimension) {
  return shared::sample_2d(shared::sampled_pixel(sampling, pixel), dimension);
}

TEST(Sampling, LanesHaveTheSameBitsAtEveryWidth) {
  constexpr std::size_t kCount = 1024;
  AlignedVector<std::uint32_t> x(kCount), y(kCount);
  AlignedVector<float> u(kCount), v(kCount);
  for (std::size_t i = 0; i < kCount; ++i)
    x[i] = static_cast<std::uint32_t>(i % 67), y[i] = static_cast<std::uint32_t>(i * i);
  for (const Isa isa : supported_isas())
    for (const int sequence : kAllSequences)
      for (const std::uint32_t dimension : {0u, 1u, shared::kMirrorDimension + shared::kDimensionsOfBounce}) {
        for (const std::uint32_t count : {16u, 64u}) {
          const shared::Sampling sampling{sequence, 37, 5, count};
          lane_probe(isa).samples(sampling, x.data(), y.data(), dimension, u.data(), v.data(), kCount);
          for (std::size_t i = 0; i < kCount; ++i) {
            const glm::vec2 expected = sample_of(sampling, {x[i], y[i]}, dimension);
            ASSERT_EQ(u[i], expected.x) << isa_name(isa) << " sequence " << sequence;
            ASSERT_EQ(v[i], expected.y) << isa_name(isa) << " sequence " << sequence;
          }
        }
      }
}

// Of the first 2^k points of a (0, 2)-sequence each box of 2^-a by 2^-(k - a) holds one (Sobol 1967).
TEST(Sampling, SobolPointsAreEvenlySpreadInEveryBox) {
  for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(17, 3), glm::uvec2(799, 599)})
    for (const std::uint32_t dimension : {0u, 3u, shared::kLensDimension})
      for (int k = 1; k <= 8; ++k)
        for (int a = 0; a <= k; ++a) {
          std::vector<int> boxes(std::size_t{1} << k);
          for (std::uint32_t i = 0; i < 1u << k; ++i) {
            const glm::vec2 p = sample_of({shared::kSequenceSobol, i, 1, 0}, pixel, dimension);
            const auto column = static_cast<std::size_t>(std::ldexp(p.x, a)),
                       row = static_cast<std::size_t>(std::ldexp(p.y, k - a));
            ++boxes[row << a | column];
          }
          ASSERT_EQ(std::count(boxes.begin(), boxes.end(), 1), 1 << k) << "2^" << k << " points, " << a;
        }
}

// Standard error of the share of the square that is left of a slanted line, over many pixels; the truth is
// 1/2.
double error_of_mean(int sequence, std::uint32_t samples) {
  double sum = 0.0;
  constexpr std::uint32_t kSide = 32;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      int inside = 0;
      for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 p = sample_of({sequence, i, 0, 1024}, {x, y}, 2);
        inside += p.x - 0.5f < 0.3f * (p.y - 0.5f) ? 1 : 0;
      }
      const double error = inside / static_cast<double>(samples) - 0.5;
      sum += error * error;
    }
  return std::sqrt(sum / (kSide * kSide));
}

// The power to which the error falls with the number of samples, from 16 to 1024 of them.
double slope_of(int sequence) {
  return std::log2(error_of_mean(sequence, 1024) / error_of_mean(sequence, 16)) / 6.0;
}

TEST(Sampling, ErrorOfAnEdgeFallsFasterThanByChance) {
  EXPECT_NEAR(slope_of(shared::kSequenceRandom), -0.5, 0.05);
  EXPECT_LT(slope_of(shared::kSequenceSobol), -0.65);
  EXPECT_LT(slope_of(shared::kSequenceBlueNoise), -0.65);
  EXPECT_LT(slope_of(shared::kSequenceZOrder), -0.65);
}

// What is left of one sample's noise in the means of 4 x 4 pixels, against the noise of a pixel: a quarter,
// were neighbours independent.
double coarse_noise(int sequence) {
  constexpr std::uint32_t kSide = 64;
  double fine = 0.0, coarse = 0.0;
  for (std::uint32_t by = 0; by < kSide; by += 4)
    for (std::uint32_t bx = 0; bx < kSide; bx += 4) {
      double block = 0.0;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const glm::vec2 p = sample_of({sequence, 0, 0, 1}, {bx + i % 4, by + i / 4}, 1);
        const double error = (p.x < 0.5f ? 1.0 : 0.0) - 0.5;
        fine += error * error / 16.0;
        block += error / 16.0;
      }
      coarse += block * block;
    }
  return std::sqrt(coarse / fine);
}

TEST(Sampling, BlueNoiseIsFineGrained) {
  EXPECT_NEAR(coarse_noise(shared::kSequenceSobol), 0.25, 0.05);
  EXPECT_LT(coarse_noise(shared::kSequenceBlueNoise), 0.12);
  EXPECT_LT(coarse_noise(shared::kSequenceZOrder), 0.12);
}

// The samples of a square of 2^a pixels a side together are what as many samples of one pixel are: each box
// of equal area holds one.
TEST(Sampling, ZOrderSpreadsTheSamplesOfSquaresTogether) {
  for (const glm::uvec2 corner : {glm::uvec2(0, 0), glm::uvec2(16, 40), glm::uvec2(792, 592)})
    for (const std::uint32_t dimension : {0u, shared::kEnvironmentDimension})
      for (const std::uint32_t samples : {1u, 4u, 16u})
        for (int a = 0; a <= 3; ++a) {
          const std::uint32_t side = 1u << a, count = samples * side * side;
          const int bits = std::countr_zero(count);
          for (int across = 0; across <= bits; ++across) {
            std::vector<int> boxes(count);
            for (std::uint32_t i = 0; i < count; ++i) {
              const std::uint32_t pixel = i / samples;
              const glm::vec2 p = sample_of({shared::kSequenceZOrder, i % samples, 1, samples},
                                            corner + glm::uvec2(pixel % side, pixel / side), dimension);
              const auto column = static_cast<std::size_t>(std::ldexp(p.x, across)),
                         row = static_cast<std::size_t>(std::ldexp(p.y, bits - across));
              ++boxes[row << across | column];
            }
            ASSERT_EQ(std::ranges::count(boxes, 1), count) << samples << " samples, side " << side;
          }
        }
}

// Two dimensions of neighbouring pixels: each quarter of their square has a quarter of the pixels, about.
// With blue noise some pairs are turned alike from pixel to pixel.
TEST(Sampling, DimensionsOfNeighboursAreIndependentInZOrder) {
  constexpr std::uint32_t kSide = 32;
  for (std::uint32_t dimension = 1; dimension < 12; ++dimension) {
    int alike = 0;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const auto low = [&](std::uint32_t d) {
        return sample_of({shared::kSequenceZOrder, 0, 3, 4}, {i % kSide, i / kSide}, d).x < 0.5f;
      };
      alike += low(0) == low(dimension) ? 1 : 0;
    }
    EXPECT_NEAR(alike, kSide * kSide / 2.0, 80.0) << dimension;  // 5 standard deviations
  }
}

// A picture that gathers more samples than it was said to have goes on with each pixel's own.
TEST(Sampling, ZOrderGoesOnWithSobolsPoints) {
  for (const std::uint32_t i : {4u, 5u, 1000u})
    EXPECT_EQ(sample_of({shared::kSequenceZOrder, i, 1, 4}, {7, 9}, 2),
              sample_of({shared::kSequenceSobol, i, 1, 4}, {7, 9}, 2));
}

// Neighbours, dimensions and seeds share nothing.
TEST(Sampling, PixelsDimensionsAndSeedsAreIndependent) {
  const auto correlation = [](auto first, auto second) {
    double sum = 0.0;
    constexpr std::uint32_t kCount = 4096;
    for (std::uint32_t i = 0; i < kCount; ++i) sum += (first(i) - 0.5) * (second(i) - 0.5) * 12.0;
    return sum / kCount;
  };
  const auto at = [](std::uint32_t seed, std::uint32_t x, std::uint32_t dimension) {
    return [=](std::uint32_t i) {
      return static_cast<double>(
          sample_of({shared::kSequenceSobol, i % 64, seed, 0}, {x + i / 64, 7}, dimension).x);
    };
  };
  EXPECT_NEAR(correlation(at(0, 0, 0), at(0, 1, 0)), 0.0, 0.06);
  EXPECT_NEAR(correlation(at(0, 0, 0), at(0, 0, 1)), 0.0, 0.06);
  EXPECT_NEAR(correlation(at(0, 0, 0), at(1, 0, 0)), 0.0, 0.06);
  EXPECT_NEAR(correlation(at(0, 0, 0), at(0, 0, 0)), 1.0, 0.06);
}

}  // namespace
}  // namespace pinocchio
