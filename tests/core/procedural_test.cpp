#include <map>

#include "core/procedural/scenes.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Scene make(const std::string& name, int triangles = 0) {
  return *make_procedural(name, {triangles});
}

TEST(Procedural, EveryNameMakesASoundScene) {
  for (const std::string& name : procedural_names()) {
    const Scene scene = make(name, 20000);
    const Expected<void> checked = check_scene(scene);
    EXPECT_TRUE(checked) << name << ": " << checked.error().message();
    EXPECT_FALSE(scene.lights.empty()) << name;
    EXPECT_FALSE(scene.cameras.empty()) << name;
    for (const glm::vec3& n : scene.normals) {
      const float length = glm::length(n);
      ASSERT_TRUE(length == 0.0f || std::abs(length - 1.0f) < 1e-4f) << name << " " << length;
    }
  }
  EXPECT_FALSE(make_procedural("nothing"));
}

TEST(Procedural, ScenesScale) {
  EXPECT_NEAR(static_cast<double>(make("speedboat").triangles.size()), 16000.0, 1600.0);
  EXPECT_NEAR(static_cast<double>(make("speedboat", 100000).triangles.size()), 100000.0, 20000.0);
  EXPECT_NEAR(static_cast<double>(make("forest", 50000).triangles.size()), 50000.0, 5000.0);
  EXPECT_GT(make("spd:balls").triangles.size(), 100000u);
}

TEST(Procedural, TwoLightsHasTwoLightsOfWhichOneCasts) {
  const Scene scene = make("two-lights");
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(casting_lights(scene).size(), 1u);
}

TEST(Procedural, SameEveryTime) {
  for (const std::string& name : procedural_names()) {
    const Scene a = make(name, 10000), b = make(name, 10000);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
  }
}

TEST(Procedural, NoTriangleIsWithoutArea) {
  for (const char* name : {"two-lights", "cornell", "speedboat"}) {
    const Scene scene = make(name);
    for (const glm::uvec3& t : scene.triangles) {
      const glm::vec3 n = glm::cross(scene.positions[t.y] - scene.positions[t.x],
                                     scene.positions[t.z] - scene.positions[t.x]);
      ASSERT_GT(glm::length(n), 0.0f) << name;
    }
  }
}

TEST(Procedural, TheGlassBallIsClosedAndItsOutsideIsOut) {
  const Scene scene = make("cornell");
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double volume = 0.0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    if (!scene.material_of(i).transmits()) continue;
    const glm::uvec3& t = scene.triangles[i];
    for (int c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
    volume += glm::dot(glm::dvec3(scene.positions[t.x]),
                       glm::cross(glm::dvec3(scene.positions[t.y]), glm::dvec3(scene.positions[t.z]))) /
              6.0;
  }
  ASSERT_FALSE(edges.empty());
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);  // its other side, the other way round
  }
  EXPECT_NEAR(volume, 4.0 / 3.0 * 3.14159265 * 0.355 * 0.355 * 0.355, 0.002);
}

}  // namespace
}  // namespace pinocchio
