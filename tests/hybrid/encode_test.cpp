#include "hybrid/exchange/encode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <vector>

namespace pinocchio {
namespace {

TEST(Formats, NarrowIdsAreWidened) {
  const std::vector<std::uint16_t> narrow{0, 1, 65534, 0xffff};
  Image<std::uint32_t> ids({2, 2});
  unpack_ids(std::as_bytes(std::span(narrow)), 16, ids);
  EXPECT_EQ(ids[2], 65534u);
  EXPECT_EQ(ids[3], 0xffffffffu);
}

TEST(Formats, RadianceIsRoundedToNearestAndStaysFinite) {
  Image<glm::vec3> radiance({3, 2}, glm::vec3(0.0f));
  radiance[1] = {1.0f / 3.0f, 1e9f, 1e-9f};
  radiance[5] = {-1e9f, -1.0f, 65504.0f};
  std::vector<std::byte> bytes(6 * 6);
  Workers workers(2);
  pack_radiance(radiance, ReflectionFormat::half, workers, bytes);
  const auto* halves = reinterpret_cast<const std::uint16_t*>(bytes.data());
  EXPECT_EQ(halves[3], glm::packHalf1x16(1.0f / 3.0f));
  EXPECT_EQ(glm::unpackHalf1x16(halves[4]), 65504.0f);
  EXPECT_EQ(glm::unpackHalf1x16(halves[15]), -65504.0f);
  EXPECT_EQ(glm::unpackHalf1x16(halves[16]), -1.0f);
}

TEST(Formats, PictureComesBackAsFloats) {
  std::vector<std::uint16_t> halves{glm::packHalf1x16(0.5f), glm::packHalf1x16(2.0f), glm::packHalf1x16(0.0f),
                                    glm::packHalf1x16(1.0f)};
  Image<glm::vec4> color({1, 1});
  unpack_picture(std::as_bytes(std::span(halves)), color);
  EXPECT_EQ(color[0], glm::vec4(0.5f, 2.0f, 0.0f, 1.0f));
}

}  // namespace
}  // namespace pinocchio
