// Figures whose values can be had with pencil and paper.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/compare/comparison.h"
#include "core/compare/magma.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr glm::ivec2 kComparedSize{8, 6};

ExrFile flat(float value) {
  ExrFile exr;
  exr.display_size = {20, 20};
  exr.data_window = {{3, 4}, glm::ivec2(3, 4) + kComparedSize};
  for (const char* name : {"B", "G", "R"})
    exr.channels.push_back({name, ExrChannel::Type::half, std::vector<float>(48, value), {}});
  return exr;
}

void add_uints(ExrFile& exr, const std::string& name, std::uint32_t value) {
  exr.channels.push_back({name, ExrChannel::Type::uint, {}, std::vector<std::uint32_t>(48, value)});
}

class CompareTest : public testing::Test {
 protected:
  Expected<Comparison> run(const ExrFile& a, const ExrFile& b, const CompareOptions& options = {}) {
    return compare({"a.exr", a}, {"b.exr", b}, options, workers_);
  }
  void expect_error(const ExrFile& a, const ExrFile& b, const std::string& words,
                    const CompareOptions& options = {}) {
    const auto result = run(a, b, options);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message().find(words), std::string::npos) << result.error().message();
  }

  Workers workers_{2};
};

TEST_F(CompareTest, ClosedForms) {
  const Comparison c = run(flat(0.75f), flat(0.5f)).value();
  EXPECT_NEAR(c.rgb.rmse, 0.25, 1e-12);
  EXPECT_NEAR(c.rgb.relative_mse, 0.0625 / 0.26, 1e-12);
  EXPECT_NEAR(c.rgb.psnr_db, 20.0 * std::log10(4.0), 1e-9);
  EXPECT_EQ(c.rgb.max_difference, 0.25);
}

TEST_F(CompareTest, OneValueOfManyIsWeighedByTheirNumber) {
  ExrFile a = flat(0.0f);
  a.channels[1].values[17] = 3.0f;
  const Comparison c = run(a, flat(0.0f)).value();
  EXPECT_NEAR(c.rgb.rmse, std::sqrt(9.0 / 144.0), 1e-12);
  EXPECT_NEAR(c.rgb.relative_mse, 900.0 / 144.0, 1e-9);
  EXPECT_NEAR(c.rgb.psnr_db, 10.0 * std::log10(144.0), 1e-9);  // 3 counts as 1
  EXPECT_EQ(c.rgb.max_difference, 3.0);
}

TEST_F(CompareTest, APictureAgainstItselfIsZero) {
  ExrFile a = flat(0.3f);
  for (std::size_t i = 0; i < 48; ++i) a.channels[i % 3].values[i] = static_cast<float>(i) * 0.37f - 2.0f;
  a.channels.push_back({"Z", ExrChannel::Type::real, std::vector<float>(48, kInf), {}});
  add_uints(a, "shadow.mask", 5);
  CompareOptions options;
  options.all_channels = true;
  const Comparison c = run(a, a, options).value();
  EXPECT_EQ(c.rgb.rmse, 0.0);
  EXPECT_EQ(c.rgb.relative_mse, 0.0);
  EXPECT_EQ(c.rgb.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.rgb.max_difference, 0.0);
  EXPECT_EQ(c.mean_flip, 0.0);
  EXPECT_EQ(c.mask.value().share(), 0.0);
  ASSERT_EQ(c.channels.size(), 5u);
  for (const auto& [name, figures] : c.channels) EXPECT_EQ(figures.differing, 0u) << name;
}

TEST_F(CompareTest, MaskBitsWhereSomethingIsSeenInEither) {
  ExrFile a = flat(0.0f), b = flat(0.0f);
  add_uints(a, "shadow.mask", 0b01);
  add_uints(b, "shadow.mask", 0b01);
  add_uints(a, "id.triangle", kNoTriangle);
  add_uints(b, "id.triangle", kNoTriangle);
  const auto set = [](ExrFile& exr, std::size_t channel, std::size_t pixel, std::uint32_t value) {
    exr.channels[channel].uints[pixel] = value;
  };
  set(a, 4, 0, 7);       // seen in a alone
  set(b, 4, 1, 7);       // in b alone
  set(a, 3, 0, 0b10);    // two bits differ
  set(a, 3, 2, 0b1000);  // where nothing is seen
  const MaskFigures two = run(a, b).value().mask.value();
  EXPECT_EQ(two.slots, 2);  // the highest bit set
  EXPECT_EQ(two.bits, 4u);
  EXPECT_EQ(two.differing, 2u);
  b.attributes["pinocchio.lights"] = std::string(R"([{"name":"x"},{"name":"y"},{"name":"z"}])");
  EXPECT_EQ(run(a, b).value().mask.value().bits, 6u);
  b.attributes["pinocchio.lights"] = std::string("{[");
  EXPECT_EQ(run(a, b).value().mask.value().bits, 4u);
}

TEST_F(CompareTest, MasksOfMoreThan32Lights) {
  ExrFile a = flat(0.0f), b = flat(0.0f);
  add_uints(a, "shadow.mask", 1);
  add_uints(a, "shadow.mask1", 0b100);
  add_uints(b, "shadow.mask", 1);
  const MaskFigures missing = run(a, b).value().mask.value();  // what b lacks is dark
  EXPECT_EQ(missing.slots, 35);
  EXPECT_EQ(missing.differing, 48u);
  add_uints(b, "shadow.mask1", 0b100);
  EXPECT_EQ(run(a, b).value().mask.value().differing, 0u);
  std::string lights = "[0";
  for (int i = 1; i < 40; ++i) lights += ", 0";
  b.attributes["pinocchio.lights"] = lights + "]";
  EXPECT_EQ(run(a, b).value().mask.value().bits, 48u * 40u);
}

TEST_F(CompareTest, WithoutAMaskItSaysSo) {
  ExrFile a = flat(0.0f);
  add_uints(a, "shadow.mask", 0);
  const Comparison c = run(a, flat(0.0f)).value();
  EXPECT_FALSE(c.mask);
  EXPECT_NE(c.no_mask.find("b.exr has no"), std::string::npos) << c.no_mask;
}

TEST_F(CompareTest, ChannelsThatHoldInfinity) {
  ExrFile a = flat(0.0f), b = flat(0.0f);
  a.channels.push_back({"Z", ExrChannel::Type::real, std::vector<float>(48, 1.0f), {}});
  b.channels.push_back({"Z", ExrChannel::Type::real, std::vector<float>(48, 1.0f), {}});
  a.channels[3].values[0] = b.channels[3].values[0] = kInf;  // equal
  a.channels[3].values[1] = b.channels[3].values[1] = kNan;  // equal
  a.channels[3].values[2] = kInf;                            // differs
  a.channels[3].values[3] = 3.0f;                            // differs, by 2
  const ChannelFigures z = run(a, b, {67.0f, {"Z"}, false}).value().channels.at(0).second;
  EXPECT_EQ(z.differing, 2u);
  EXPECT_EQ(z.not_finite, 1u);
  EXPECT_NEAR(z.errors.rmse, std::sqrt(4.0 / 45.0), 1e-12);
  EXPECT_EQ(z.errors.max_difference, 2.0);
}

TEST_F(CompareTest, Errors) {
  ExrFile bad = flat(0.0f);
  bad.channels[0].values[9] = kNan;
  bad.channels[2].values[8] = -kInf;
  expect_error(bad, flat(0.0f), "a.exr: NaN or infinity in R, G or B of 2 pixels, first at (3, 5)");
  expect_error(flat(0.0f), bad, "b.exr: NaN");
  ExrFile other = flat(0.0f);
  other.display_size = {21, 20};
  expect_error(other, flat(0.0f), "the picture's size is 21x20, that of b.exr is 20x20");
  other = flat(0.0f);
  other.data_window = {{4, 4}, glm::ivec2(4, 4) + kComparedSize};
  expect_error(other, flat(0.0f), "the data window is 8x6 at (4, 4), that of b.exr is 8x6 at (3, 4)");
  other = flat(0.0f);
  other.channels.erase(other.channels.begin());
  expect_error(flat(0.0f), other, "b.exr: has no channel 'B'; it has G, R");
  expect_error(flat(0.0f), flat(0.0f), "has no channel 'Z'", {67.0f, {"Z"}, false});
  ExrFile uints = flat(0.0f), floats = flat(0.0f);
  add_uints(uints, "Z", 1);
  floats.channels.push_back({"Z", ExrChannel::Type::real, std::vector<float>(48, 1.0f), {}});
  expect_error(uints, floats, "channel 'Z' holds integers", {67.0f, {"Z"}, false});
}

TEST(MagmaTest, RunsFromBlackToPaleYellow) {
  Image<float> errors({4, 1});
  errors[0] = -1.0f;
  errors[1] = 1.0f;
  errors[2] = 0.5f;
  errors[3] = 7.0f;
  const Image<glm::u8vec3> colors = magma(errors);
  EXPECT_EQ(colors[0], glm::u8vec3(0, 0, 4));
  EXPECT_EQ(colors[1], glm::u8vec3(252, 253, 191));
  EXPECT_EQ(colors[3], colors[1]);
  EXPECT_GT(colors[2].r, colors[2].b);
}

}  // namespace
}  // namespace pinocchio
