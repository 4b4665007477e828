#include <map>

#include "core/trace/view/view_params.h"
#include "pinocchio/tracer.h"
#include "scenes/generator/scenes.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

bool has_fixed_shape(const std::string& name) {
  return name == "cornell" || name == "two-lights";
}

// Of about as many triangles, where the scene can have them.
Scene make(const std::string& name, int triangles = 0) {
  return *make_procedural(name, {has_fixed_shape(name) ? 0 : triangles});
}

TEST(Procedural, EveryNameMakesASoundScene) {
  for (const std::string& name : procedural_names()) {
    const Scene scene = make(name, 20000);
    const Expected<void> checked = check_scene(scene);
    EXPECT_TRUE(checked) << name << ": " << checked.error().message();
    EXPECT_FALSE(scene.lights.empty()) << name;
    EXPECT_FALSE(scene.cameras.empty()) << name;
    for (const glm::vec3& n : scene.mesh->normals) {
      const float length = glm::length(n);
      ASSERT_TRUE(length == 0.0f || std::abs(length - 1.0f) < 1e-4f) << name << " " << length;
    }
  }
  EXPECT_FALSE(make_procedural("nothing"));
  EXPECT_FALSE(make_procedural("cornell", {20000}));
}

void expect_about(const std::string& name, int triangles, int asked, double tolerance) {
  const auto made = static_cast<double>(make(name, asked).mesh->triangles.size());
  EXPECT_NEAR(made, triangles, tolerance * triangles) << name << " asked for " << asked;
}

TEST(Procedural, ScenesScale) {
  expect_about("speedboat", 16'000, 0, 0.10);
  expect_about("forest", 1'000'000, 0, 0.05);
  expect_about("spd:balls", 400'000, 0, 0.10);
  for (const int asked : {10'000, 50'000, 100'000, 400'000}) {
    expect_about("speedboat", asked, asked, 0.10);
    expect_about("spd:balls", asked, asked, 0.25);  // spheres are cut in coarse steps
  }
  for (const int asked : {50'000, 400'000}) expect_about("forest", asked, asked, 0.10);
}

TEST(Procedural, TheSphereflakeHasFourLevels) {
  // A sphere of triangles has V - E + F = 2 and E = 3/2 F, so each adds 4 to 2 V - F.
  const Scene scene = make("spd:balls");
  long long corners = 0, faces = 0;
  std::vector<bool> seen(scene.mesh->positions.size(), false);
  for (std::uint32_t i = 0; i < scene.mesh->triangles.size(); ++i) {
    if (scene.mesh->material_of(i).name != "gold") continue;
    ++faces;
    for (int c = 0; c < 3; ++c) {
      corners += seen[scene.mesh->triangles[i][c]] ? 0 : 1;
      seen[scene.mesh->triangles[i][c]] = true;
    }
  }
  EXPECT_EQ(2 * corners - faces, 4 * (1 + 9 + 81 + 729 + 6561));
}

TEST(Procedural, NothingIsSeenOfTheVoid) {
  for (const std::string& name : procedural_names()) {
    const Scene scene = make(name, 20000);
    const Tracer tracer(scene.mesh);
    const shared::ViewParams view = view_params(scene.cameras.front(), {80, 60});
    std::vector<Ray> rays;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 80; ++x) rays.push_back(pixel_ray(view, x, y));
    std::vector<Hit> hits(rays.size());
    tracer.closest_hits(rays, hits);
    for (const Hit& hit : hits) ASSERT_TRUE(hit.valid()) << name;
  }
}

TEST(Procedural, TwoLightsHasTwoLightsOfWhichOneCasts) {
  const Scene scene = make("two-lights");
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(casting_lights(scene).size(), 1u);
}

TEST(Procedural, SameEveryTime) {
  for (const std::string& name : procedural_names()) {
    const Scene a = make(name, 10000), b = make(name, 10000);
    EXPECT_EQ(a.mesh->positions, b.mesh->positions);
    EXPECT_EQ(a.mesh->normals, b.mesh->normals);
    EXPECT_EQ(a.mesh->triangles, b.mesh->triangles);
    EXPECT_EQ(a.mesh->triangle_materials, b.mesh->triangle_materials);
  }
}

TEST(Procedural, NoTriangleIsWithoutArea) {
  for (const char* name : {"two-lights", "cornell", "speedboat"}) {
    const Scene scene = make(name);
    for (const glm::uvec3& t : scene.mesh->triangles) {
      const glm::vec3 n = glm::cross(scene.mesh->positions[t.y] - scene.mesh->positions[t.x],
                                     scene.mesh->positions[t.z] - scene.mesh->positions[t.x]);
      ASSERT_GT(glm::length(n), 0.0f) << name;
    }
  }
}

TEST(Procedural, TheGlassBallIsClosedAndItsOutsideIsOut) {
  const Scene scene = make("cornell");
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double volume = 0.0;
  const Mesh& mesh = *scene.mesh;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!mesh.material_of(i).transmits()) continue;
    const glm::uvec3& t = mesh.triangles[i];
    for (int c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
    volume += glm::dot(glm::dvec3(mesh.positions[t.x]),
                       glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z]))) /
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
