#include "pinocchio/environment.h"

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <glm/gtc/constants.hpp>

#include "core/scene/sky/brightness.h"
#include "pinocchio/exr.h"
#include "tests/core/scene/sky/skies.h"
#include "tests/core/trace/environment_columns.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

ExrFile exr_of(const Image<glm::vec3>& image) {
  ExrFile exr;
  exr.display_size = image.size();
  exr.data_window = {{0, 0}, image.size()};
  for (const int c : {0, 1, 2}) {
    ExrChannel channel{std::string(1, "RGB"[c]), ExrChannel::Type::real, {}, {}};
    for (const glm::vec3& p : image.pixels()) channel.values.push_back(p[c]);
    exr.channels.push_back(std::move(channel));
  }
  return exr;
}

// RGBE without run lengths.
void write_hdr(const std::filesystem::path& file, glm::ivec2 size, const std::string& texel,
               std::size_t missing = 0) {
  std::ofstream out(file, std::ios::binary);
  out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << size.y << " +X " << size.x << "\n";
  std::string bytes;
  for (int i = 0; i < size.x * size.y; ++i) bytes += texel;
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size() - missing));
}

TEST(Environment, IsReadFromExrAndRadiance) {
  const Image<glm::vec3> image = sky({12, 6});
  write_exr(own_file("sky.exr"), exr_of(image));
  const auto exr = load_environment(own_file("sky.exr"));
  ASSERT_TRUE(exr) << exr.error().message();
  EXPECT_TRUE(std::ranges::equal((*exr)->radiance().pixels(), image.pixels()));

  write_hdr(own_file("sky.hdr"), {4, 2},
            std::string("\x80\x40\x20\x82", 4));  // 2^2 times halves, quarters, eighths
  const auto hdr = load_environment(own_file("sky.hdr"));
  ASSERT_TRUE(hdr) << hdr.error().message();
  EXPECT_EQ((*hdr)->radiance().size(), glm::ivec2(4, 2));
  EXPECT_EQ((*hdr)->radiance().at(3, 1), glm::vec3(2.0f, 1.0f, 0.5f));
}

// Each line packed by channels or not; there, a pixel repeated the old way.
TEST(Environment, RadianceLinesArePackedOrPlain) {
  const std::string head = "#?RGBE\n# by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n-Y 2 +X 8\n";
  const auto channel = [](char value) {
    return std::string{static_cast<char>(133), value, 3, value, value, value};
  };
  const std::string packed =
      std::string("\2\2\0\10", 4) + channel('\x80') + channel('\x40') + channel('\x20') + channel('\x82');
  const std::string plain = std::string("\x80\x40\x20\x82\x20\x40\x80\x81\1\1\1\6", 12);
  std::ofstream(own_file("both.hdr"), std::ios::binary) << head + packed + plain;
  const auto sky = load_environment(own_file("both.hdr"));
  ASSERT_TRUE(sky) << sky.error().message();
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ((*sky)->radiance().at(x, 0), glm::vec3(2.0f, 1.0f, 0.5f)) << x;
    EXPECT_EQ((*sky)->radiance().at(x, 1),
              x == 0 ? glm::vec3(2.0f, 1.0f, 0.5f) : glm::vec3(0.25f, 0.5f, 1.0f))
        << x;
  }
  for (const std::string& bad :
       {packed + plain.substr(0, 11), packed.substr(0, 9), std::string("\2\2\0\10\0\0\0\0\0\0\0\0", 12),
        std::string("\2\2\0\10\xff\1", 6), std::string("\1\1\1\6", 4)}) {
    std::ofstream(own_file("bad.hdr"), std::ios::binary) << head + bad;
    EXPECT_FALSE(load_environment(own_file("bad.hdr")));
  }
  std::ofstream(own_file("none.hdr"), std::ios::binary) << "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 8\n";
  EXPECT_FALSE(load_environment(own_file("none.hdr")));
}

TEST(Environment, BadFilesAreErrorsThatNameThem) {
  const auto error_of = [](const std::filesystem::path& file, std::uint64_t limit = kUsualLoadLimit) {
    const auto loaded = load_environment(file, nullptr, limit);
    EXPECT_FALSE(loaded) << file;
    return loaded ? std::string() : loaded.error().message();
  };
  EXPECT_NE(error_of(own_file("missing.exr")).find("missing.exr"), std::string::npos);
  std::ofstream(own_file("text.hdr")) << "hello";
  EXPECT_NE(error_of(own_file("text.hdr")).find("neither EXR nor Radiance"), std::string::npos);
  std::ofstream(own_file("header.hdr")) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y none";
  EXPECT_NE(error_of(own_file("header.hdr")).find("header.hdr"), std::string::npos);

  write_exr(own_file("sky.exr"), exr_of(sky({64, 32})));
  std::filesystem::copy(own_file("sky.exr"), own_file("cut.exr"));
  std::filesystem::resize_file(own_file("cut.exr"), std::filesystem::file_size(own_file("cut.exr")) / 2);
  EXPECT_NE(error_of(own_file("cut.exr")).find("cut.exr"), std::string::npos);
  EXPECT_NE(error_of(own_file("sky.exr"), 1000).find("--load-limit"), std::string::npos);
  write_hdr(own_file("large.hdr"), {64, 32}, std::string("\x80\x40\x20\x82", 4));
  EXPECT_NE(error_of(own_file("large.hdr"), 1000).find("--load-limit"), std::string::npos);

  ExrFile depth = exr_of(sky({4, 2}));
  for (ExrChannel& channel : depth.channels) channel.name = "Z" + channel.name;
  write_exr(own_file("depth.exr"), depth);
  EXPECT_NE(error_of(own_file("depth.exr")).find("no channels"), std::string::npos);
}

// What a sample's direction finds is what it brought, over its likelihood; together they are the whole sky's
// light. Every width has the same bits.
TEST(Environment, SamplesBringTheWholeSky) {
  Scene scene = under(sky({32, 16}), {});
  scene.environment_rotation_deg = 33.0f;
  scene.environment_strength = 0.5f;
  constexpr int kSide = 1024;
  EnvironmentColumns samples(kSide * kSide);
  for (std::size_t i = 0; i < samples.u.size(); ++i) {
    samples.u[i] = (static_cast<float>(i % kSide) + 0.5f) / kSide;
    samples.v[i] = (static_cast<float>(i / kSide) + 0.5f) / kSide;
  }
  samples.sample(scene);
  EnvironmentColumns seen = samples;
  seen.look_up(scene);
  glm::dvec3 sampled(0.0), exact(0.0);
  for (std::size_t i = 0; i < samples.u.size(); ++i) {
    ASSERT_NEAR(glm::length(samples.direction_of(i)), 1.0f, 1e-5f);
    ASSERT_LT(glm::length(glm::normalize(samples.light_of(i)) - glm::normalize(seen.light_of(i))), 0.02f);
    ASSERT_NEAR(samples.density[i] / seen.density[i], 1.0f, 0.02f) << i;
    sampled += glm::dvec3(samples.light_of(i)) / double{kSide * kSide};
  }
  EnvironmentColumns sphere(kSide * kSide);  // evenly over it
  for (std::size_t i = 0; i < sphere.u.size(); ++i) {
    const float height = 2.0f * (static_cast<float>(i / kSide) + 0.5f) / kSide - 1.0f,
                across = std::sqrt(1.0f - height * height);
    const float turn = glm::two_pi<float>() * (static_cast<float>(i % kSide) + 0.5f) / kSide;
    sphere.set_direction(i, {across * std::cos(turn), height, across * std::sin(turn)});
  }
  sphere.look_up(scene);
  double density = 0.0;
  for (std::size_t i = 0; i < sphere.u.size(); ++i) {
    const double area = 4.0 * glm::pi<double>() / (double{kSide} * kSide);
    exact += glm::dvec3(sphere.light_of(i)) * area;
    density += static_cast<double>(sphere.density[i]) * area;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sampled[c] / exact[c], 1.0, 0.005);
  EXPECT_NEAR(density, 1.0, 0.005);
  for (const Isa isa : supported_isas()) {
    EnvironmentColumns again = samples, seen_again = seen;
    again.sample(scene, isa);
    seen_again.look_up(scene, isa);
    EXPECT_TRUE(again == samples && seen_again == seen) << static_cast<int>(isa);
  }
}

float unpacked_brightness(std::uint32_t packed) {
  return std::bit_cast<float>((packed << kBrightnessShift) + kLeastBrightness);
}

TEST(Environment, PackedBrightnessIsRoundedUpAndNeverZero) {
  EXPECT_GT(unpacked_brightness(packed_brightness(0.0f)), 0.0f);
  EXPECT_EQ(unpacked_brightness(packed_brightness(1.0f)), 1.0f);
  for (float share = 0x1p-31f; share <= 1.0f; share *= 1.0007f) {
    const std::uint32_t packed = packed_brightness(share);
    ASSERT_LT(packed, 256u);
    ASSERT_GE(unpacked_brightness(packed), share);
    ASSERT_LE(unpacked_brightness(packed), share * 1.125f);
  }
}

// Each word has the four texels around: those of the other side at the right edge, twice the same row above
// the first and below the last.
TEST(Environment, BrightnessHasTheTexelsAroundASquare) {
  Image<glm::vec3> sky({4, 2});
  for (std::size_t i = 0; i < 8; ++i) sky[i] = glm::vec3(std::ldexp(1.0f, -static_cast<int>(i)));
  const Environment environment(sky);
  const auto corners = [&](int x, int row) {
    const std::uint32_t word = environment.brightness()[4 * row + x];
    std::array<int, 4> powers{};
    for (unsigned k = 0; k < 4; ++k)
      powers[k] = static_cast<int>(-std::log2(unpacked_brightness(word >> 8 * k & 0xffu)));
    return powers;
  };
  EXPECT_EQ(corners(1, 1), (std::array{1, 2, 5, 6}));
  EXPECT_EQ(corners(3, 1), (std::array{3, 0, 7, 4}));
  EXPECT_EQ(corners(0, 0), (std::array{0, 1, 0, 1}));
  EXPECT_EQ(corners(0, 2), (std::array{4, 5, 4, 5}));
}

TEST(Environment, AnglesAreRoundedOnce) {
  constexpr std::size_t kCount = 4096;
  AlignedVector<float> turns(kCount), cosine(kCount), sine(kCount);
  for (std::size_t i = 0; i < kCount; ++i) turns[i] = static_cast<float>(i) / 1537.0f - 1.0f;
  for (const Isa isa : supported_isas()) {
    lane_probe(isa).angles(turns.data(), cosine.data(), sine.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double radians = glm::two_pi<double>() * static_cast<double>(turns[i]);
      EXPECT_NEAR(cosine[i], std::cos(radians), 6.0e-8) << turns[i];
      EXPECT_NEAR(sine[i], std::sin(radians), 6.0e-8) << turns[i];
    }
  }
}

// OpenEXR's latitude-longitude maps: the middle is +Z, a quarter of the width to the left +X.
TEST(Environment, IsTheRightWayAround) {
  Image<glm::vec3> image({8, 4});
  image.at(1, 1) = image.at(2, 1) = image.at(1, 2) = image.at(2, 2) = {1, 0, 0};
  image.at(3, 1) = image.at(4, 1) = image.at(3, 2) = image.at(4, 2) = {0, 1, 0};
  for (int x = 0; x < 8; ++x) image.at(x, 0) = {0, 0, 1};
  Scene scene = under(image, {});
  EXPECT_GT(light_from(scene, {1, 0, 0}).r, 0.9f);
  EXPECT_GT(light_from(scene, {0, 0, 2}).g, 0.9f);
  EXPECT_GT(light_from(scene, {0, 3, 0}).b, 0.9f);
  scene.environment_rotation_deg = 90.0f;  // about +Y: what was at +Z is at +X
  EXPECT_GT(light_from(scene, {1, 0, 0}).g, 0.9f);
}

}  // namespace
}  // namespace pinocchio
