// FLIP against its authors' own program: recorded values, and live where it is installed.
#include "core/compare/flip.h"

#include <gtest/gtest.h>
#include "tests/support/own_file.h"

#include <cmath>
#include <string>

#include "tests/support/command.h"

namespace pinocchio {
namespace {

using Picture = Image<glm::vec3>;

// A number in [0, 1) for every n, the same on every machine.
float noise(std::uint32_t n) {
  n = (n ^ 61u) ^ (n >> 16);
  n *= 9u;
  n = (n ^ (n >> 4)) * 0x27d4eb2du;
  n ^= n >> 15;
  return static_cast<float>(n >> 16) / 65536.0f;
}

template <class Value>
Picture picture(glm::ivec2 size, const Value& value) {
  Picture result(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) result.at(x, y) = value(x, y);
  return result;
}

struct Pair {
  const char* name;
  Picture a, b;
  float pixels_per_degree;
  double mean, max;  // recorded
};

glm::vec3 edges(int x, int y) {
  return (x / 12 + y / 9) % 2 ? glm::vec3(0.9f, 0.8f, 0.1f) : glm::vec3(0.05f, 0.1f, 0.4f);
}

// Recorded by flip-evaluator 1.7: FLIP.LiveReference prints them where that is installed.
std::vector<Pair> pairs() {
  const auto noisy = [](std::uint32_t seed) {
    return picture({96, 64}, [seed](int x, int y) {
      const auto n = static_cast<std::uint32_t>(3 * (y * 96 + x)) + seed;
      return glm::vec3(noise(n), noise(n + 1), noise(n + 2));
    });
  };
  return {{"noise", noisy(0), noisy(1000000), 67.0f, 0.3934062, 0.9670543},
          {"shifted edges", picture({97, 61}, edges),
           picture({97, 61}, [](int x, int y) { return edges(x + 2, y + 1); }), 67.0f, 0.5437743, 0.9672145},
          {"gradients",
           picture({120, 80},
                   [](int x, int y) {
                     return glm::vec3(static_cast<float>(x) / 119.0f, static_cast<float>(y) / 79.0f, 0.25f);
                   }),
           picture({120, 80},
                   [](int x, int y) {
                     return glm::vec3(0.25f, static_cast<float>(y) / 79.0f, static_cast<float>(x) / 119.0f);
                   }),
           67.0f, 0.6023084, 0.9577616},
          {"edges from near", picture({97, 61}, edges),
           picture({97, 61}, [](int x, int y) { return edges(x + 2, y + 1); }), 25.0f, 0.5344010, 0.9852274}};
}

double largest(const Image<float>& errors) {
  return *std::max_element(errors.pixels().begin(), errors.pixels().end());
}

Image<float> flip_of(const Pair& pair) {
  Workers workers(2);
  return flip(pair.a, pair.b, pair.pixels_per_degree, workers);
}

TEST(FLIP, SamePicturesAreZero) {
  Workers workers(2);
  for (const Pair& pair : pairs()) EXPECT_EQ(largest(flip(pair.a, pair.a, 67.0f, workers)), 0.0) << pair.name;
}

TEST(FLIP, CanBeCancelled) {
  Workers workers(2);
  Progress progress;
  const Pair pair = pairs().front();
  EXPECT_FALSE(flip(pair.a, pair.b, 67.0f, workers, &progress).empty());
  progress.cancel();
  EXPECT_THROW((void)flip(pair.a, pair.b, 67.0f, workers, &progress), Cancelled);
}

TEST(FLIP, IsSymmetric) {
  Workers workers(2);
  for (const Pair& pair : pairs()) {
    const Image<float> ab = flip(pair.a, pair.b, 67.0f, workers), ba = flip(pair.b, pair.a, 67.0f, workers);
    EXPECT_TRUE(std::equal(ab.pixels().begin(), ab.pixels().end(), ba.pixels().begin())) << pair.name;
  }
}

TEST(FLIP, BlackAgainstWhite) {
  // Flat: no feature; a lightness difference of 100 past the knee, by the paper's formulas.
  Workers workers(1);
  const Picture black({9, 5}, glm::vec3(0.0f)), white({9, 5}, glm::vec3(1.0f));
  for (const float ppd : {kLeastPixelsPerDegree, 67.0f, kMostPixelsPerDegree}) {
    const Image<float> errors = flip(black, white, ppd, workers);
    for (const float error : errors.pixels()) EXPECT_NEAR(error, 0.967325, 1e-4);
  }
}

TEST(FLIP, BrightAndNegativeAreAsAScreenShowsThem) {
  Workers workers(1);
  const Picture bright({9, 5}, glm::vec3(40.0f)), white({9, 5}, glm::vec3(1.0f));
  EXPECT_EQ(largest(flip(bright, white, 67.0f, workers)), 0.0);
  EXPECT_EQ(
      largest(flip(Picture({9, 5}, glm::vec3(-1.0f)), Picture({9, 5}, glm::vec3(0.0f)), 67.0f, workers)),
      0.0);
}

TEST(FLIP, RecordedReference) {
  for (const Pair& pair : pairs()) {
    const Image<float> errors = flip_of(pair);
    EXPECT_NEAR(mean(errors), pair.mean, 1e-4) << pair.name;
    EXPECT_NEAR(largest(errors), pair.max, 1e-3) << pair.name;
  }
}

TEST(FLIP, LiveReference) {
  const std::filesystem::path folder = own_folder() / "flip";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const Picture& image) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.pixels().data()),
               static_cast<std::streamsize>(image.pixels().size_bytes()));
  };
  for (const Pair& pair : pairs()) {
    write("a", pair.a);
    write("b", pair.b);
    const CommandResult result =
        run_command("cd '" + folder.string() + "' && '" PINOCCHIO_SOURCE_DIR "/scripts/flip-reference' " +
                        std::to_string(pair.a.width()) + " " + std::to_string(pair.a.height()) + " " +
                        std::to_string(pair.pixels_per_degree) + " a b map",
                    folder);
    if (result.exit_code == 3 || result.exit_code == 127)  // 127: no python3
      GTEST_SKIP() << "python3 with flip-evaluator is not here; compared with recorded values alone";
    ASSERT_EQ(result.exit_code, 0) << result.err;
    Image<float> expected(pair.a.size());
    std::ifstream(folder / "map", std::ios::binary)
        .read(reinterpret_cast<char*>(expected.pixels().data()),
              static_cast<std::streamsize>(expected.pixels().size_bytes()));
    std::printf("%s: mean %.7f, max %.7f\n", pair.name, mean(expected), largest(expected));
    const Image<float> errors = flip_of(pair);
    EXPECT_NEAR(mean(errors), mean(expected), 1e-4) << pair.name;
    float off = 0.0f;
    for (std::size_t i = 0; i < errors.pixels().size(); ++i)
      off = std::max(off, std::abs(errors[i] - expected[i]));
    EXPECT_LT(off, 1e-3f) << pair.name;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pinocchio
