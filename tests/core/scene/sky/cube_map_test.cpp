#include "core/image/cube_map.h"

#include <algorithm>

#include "core/image/codecs/png.h"
#include "core/image/tonemap.h"
#include "scenes/generator/random.h"
#include "tests/core/trace/environment_columns.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

void write_face(int face, const Image<glm::u8vec4>& texels) {
  std::ofstream(own_file("face" + std::to_string(face) + ".png"), std::ios::binary) << encode_png(texels);
}

// A triangle in a box of six faces of 8 x 8 texels; what is to their right, left and top is said by `paint`.
template <class Paint>
Json boxed(Paint paint) {
  Json json = triangle_json();
  Json faces = Json::array();
  for (int face = 0; face < 6; ++face) {
    Image<glm::u8vec4> texels({8, 8});
    for (int i = 0; i < 64; ++i) texels[static_cast<std::size_t>(i)] = paint(face, i % 8, i / 8);
    write_face(face, texels);
    json["images"].push_back({{"uri", "face" + std::to_string(face) + ".png"}});
    faces.push_back(face);
  }
  json["extensionsUsed"] = {"EXT_lights_image_based"};
  json["extensions"]["EXT_lights_image_based"]["lights"] = {
      {{"specularImageSize", 8}, {"specularImages", {faces}}, {"irradianceCoefficients", Json::array()}}};
  json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  return json;
}

// Each face one level of grey.
constexpr glm::u8vec4 grey_of(int face) {
  return glm::u8vec4(glm::u8vec3(static_cast<std::uint8_t>(40 * (face + 1))), 255);
}
Json greys() {
  return boxed([](int face, int, int) { return grey_of(face); });
}
float light_of_face(int face) {
  return srgb8_to_linear(grey_of(face).r);
}

constexpr glm::vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

TEST(CubeMap, FacesOfAGltfFileAreWhereTheyLook) {
  Warnings warnings;
  const Expected<Scene> scene = load(greys(), &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(warnings.empty());
  ASSERT_NE(scene->environment, nullptr);
  EXPECT_EQ(scene->environment->radiance().size(), glm::ivec2(32, 16));
  for (int face = 0; face < 6; ++face)
    EXPECT_NEAR(light_from(*scene, kAxes[face]).g, light_of_face(face), 1e-4f) << face;
}

// Seen from the middle with +Y up, pictures are not mirrored: the left of the one ahead (-Z) is at -X.
TEST(CubeMap, FacesAreTheRightWayAround) {
  const Scene scene = load_good(
      boxed([](int, int x, int y) { return glm::u8vec4(x < 4 ? 255 : 0, y < 4 ? 255 : 0, 0, 255); }));
  const struct {
    glm::vec3 ahead, right;
  } around[] = {
      {{0, 0, -1}, {1, 0, 0}}, {{1, 0, 0}, {0, 0, 1}}, {{0, 0, 1}, {-1, 0, 0}}, {{-1, 0, 0}, {0, 0, -1}}};
  for (const auto& [ahead, right] : around)
    for (const float side : {-1.0f, 1.0f})
      for (const float up : {-1.0f, 1.0f}) {
        const glm::vec3 light =
            light_from(scene, ahead + 0.5f * side * right + glm::vec3(0.0f, 0.4f * up, 0.0f));
        EXPECT_NEAR(light.r, side < 0.0f ? 1.0f : 0.0f, 1e-4f);
        EXPECT_NEAR(light.g, up > 0.0f ? 1.0f : 0.0f, 1e-4f);
      }
  // Above, the lower edge is towards +Z; below, the upper one is.
  EXPECT_NEAR(light_from(scene, {0.5f, 1, 0.5f}).g, 0.0f, 1e-4f);
  EXPECT_NEAR(light_from(scene, {0.5f, 1, 0.5f}).r, 1.0f, 1e-4f);
  EXPECT_NEAR(light_from(scene, {0.5f, -1, 0.5f}).g, 1.0f, 1e-4f);
  EXPECT_NEAR(light_from(scene, {0.5f, -1, 0.5f}).r, 1.0f, 1e-4f);
}

TEST(CubeMap, AlphaDividesAndIntensityAndRotationCount) {
  const Scene bright = load_good(boxed([](int, int, int) { return glm::u8vec4(255, 188, 0, 51); }));
  EXPECT_NEAR(light_from(bright, {1, 2, 3}).r, 5.0f, 1e-3f);
  EXPECT_NEAR(light_from(bright, {1, 2, 3}).g, 5.0f * srgb8_to_linear(188), 1e-3f);
  Json json = greys();
  Json& light = json["extensions"]["EXT_lights_image_based"]["lights"][0];
  light["intensity"] = 2.5;
  light["rotation"] = {0, 0.70710678, 0, 0.70710678};  // a quarter about +Y: +Z goes to +X
  const Scene scene = load_good(json);
  EXPECT_NEAR(light_from(scene, {1, 0, 0}).g, 2.5f * light_of_face(4), 1e-3f);
  EXPECT_NEAR(light_from(scene, {0, 0, 1}).g, 2.5f * light_of_face(1), 1e-3f);
  EXPECT_NEAR(light_from(scene, {0, 1, 0}).g, 2.5f * light_of_face(2), 1e-3f);
}

// What latitude and longitude cost: of a smooth sky 0.5 %, also across edges and corners; of all light 0.1 %.
TEST(CubeMap, LatitudeAndLongitudeKeepItsLight) {
  const auto sky = [](const glm::vec3& d) {
    return glm::vec3(1.0f + 0.5f * d.x, 1.0f + 0.5f * d.y * d.z, std::exp(d.y));
  };
  CubeMap cube;
  constexpr int kSide = 32;
  constexpr glm::vec3 kRight[] = {{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  constexpr glm::vec3 kDown[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
  glm::dvec3 all(0.0), kept(0.0);
  for (std::size_t face = 0; face < 6; ++face) {
    cube[face] = Image<glm::vec3>({kSide, kSide});
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const glm::vec2 p = (2.0f * glm::vec2(x, y) + 1.0f) / static_cast<float>(kSide) - 1.0f;
        const glm::vec3 d = kAxes[face] + p.x * kRight[face] + p.y * kDown[face];
        cube[face].at(x, y) = sky(glm::normalize(d));
        const double angle = 4.0 / (kSide * kSide) / std::pow(static_cast<double>(glm::length(d)), 3.0);
        all += angle * glm::dvec3(cube[face].at(x, y));
      }
  }
  Scene scene;
  scene.environment = std::make_shared<const Environment>(lat_long_of(cube, glm::quat(1, 0, 0, 0)));
  const glm::ivec2 size = scene.environment->radiance().size();
  const double area = 2.0 * 3.14159265358979 * 3.14159265358979 / (size.x * size.y);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      kept += area * std::sin(3.14159265358979 * (y + 0.5) / size.y) *
              glm::dvec3(scene.environment->radiance().at(x, y));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(kept[c] / all[c], 1.0, 0.001);
  Random random(5);
  float worst = 0.0f;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 d(random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f));
    if (glm::length(d) < 0.01f) continue;
    const glm::vec3 apart = glm::abs(light_from(scene, d) / sky(glm::normalize(d)) - 1.0f);
    worst = std::max({worst, apart.r, apart.g, apart.b});
  }
  EXPECT_LT(worst, 0.01f);
}

TEST(CubeMap, WhatIsWrongWithItIsAWarning) {
  const auto without = [](const Json& json, const std::string& why) {
    Warnings warnings;
    const Expected<Scene> scene = load(json, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->environment, nullptr);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].message().find(why), std::string::npos) << warnings[0].message();
  };
  const auto bent = [](const char* pointer, const Json& value) {
    Json json = greys();
    json[Json::json_pointer(pointer)] = value;
    return json;
  };
  const std::string light = "/extensions/EXT_lights_image_based/lights/0/";
  without(bent("/scenes/0/extensions/EXT_lights_image_based/light", 7), "a light that does not exist");
  without(bent((light + "specularImages").c_str(), Json::array()), "do not begin with six images");
  without(bent((light + "specularImages/0/3").c_str(), 6), "do not begin with six images");
  without(bent("/images/2/uri", "nowhere.png"), "nowhere.png");
  write_face(9, Image<glm::u8vec4>({4, 4}));
  without(bent("/images/2/uri", "face9.png"), "not square and of one size");
  EXPECT_EQ(load_good(bent("/scenes/0/extensions", Json::object())).environment, nullptr);
}

}  // namespace
}  // namespace pinocchio
