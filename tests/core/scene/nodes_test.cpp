// Scenes whose nodes move.
#include "pinocchio/nodes.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <type_traits>

#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

glm::mat4 moved(const glm::vec3& by) {
  return glm::translate(glm::mat4(1.0f), by);
}

Scene one_triangle(const std::string& light = {}) {
  MeshData mesh;
  add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Scene scene(std::move(mesh));
  if (!light.empty()) scene.lights.push_back(point_light({0, 0, 2})), scene.lights.back().name = light;
  return scene;
}

class Nodes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Nodes,
                         testing::Values("scenes/cornell.gltf", "scenes/two-lights.gltf",
                                         "scenes/speedboat.glb"),
                         [](const auto& scene) { return "scene" + std::to_string(scene.index); });

// Away and back: the file's scene, to the last bit.
TEST_P(Nodes, ComeBackToWhereTheyWere) {
  const Scene scene = load_or_die(source_path(GetParam()));
  ASSERT_TRUE(scene.nodes);
  ASSERT_EQ(scene.nodes->rest->positions.size(), scene.mesh->positions.size());
  std::vector<NodeTransform> away, back;
  for (int n = 0; n < static_cast<int>(scene.nodes->nodes.size()); ++n) {
    const glm::mat4& local = scene.nodes->nodes[static_cast<std::size_t>(n)].local;
    away.push_back({n, moved({1, 2, 3}) * local});
    back.push_back({n, local});
  }
  const Scene there = posed(scene, away).value(), here = posed(there, back).value();
  EXPECT_NE(there.mesh->positions, scene.mesh->positions);
  EXPECT_EQ(here.mesh->positions, scene.mesh->positions);
  EXPECT_EQ(here.mesh->normals, scene.mesh->normals);
  EXPECT_EQ(here.mesh->triangles, scene.mesh->triangles);
  ASSERT_EQ(here.lights.size(), scene.lights.size());
  for (std::size_t i = 0; i < here.lights.size(); ++i)
    EXPECT_LT(glm::distance(here.lights[i].position, scene.lights[i].position), 1e-5f);
  for (std::size_t i = 0; i < here.cameras.size(); ++i)
    EXPECT_LT(glm::distance(here.cameras[i].target, scene.cameras[i].target), 1e-4f);
}

// A part does not outlive its scene.
static_assert(std::is_constructible_v<Part, std::string, const Scene&>);
static_assert(!std::is_constructible_v<Part, std::string, Scene>);

TEST(Assembled, PartsMoveWithWhatHangsOnThem) {
  const Scene a = one_triangle("a"), b = one_triangle("b");
  const std::array parts{Part{"a", a}, Part{"b", b, moved({5, 0, 0})}};
  const Scene both = assembled(parts).value();
  ASSERT_EQ(both.mesh->triangles.size(), 2u);
  EXPECT_EQ(object_of(both, 0), 0u);
  EXPECT_EQ(object_of(both, 1), 1u);
  EXPECT_EQ(both.mesh->positions[3], glm::vec3(5, 0, 0));
  EXPECT_EQ(both.lights[1].position, glm::vec3(5, 0, 2));

  // A node of a node: "pair" carries both, "b" stays 5 from its own origin's parent.
  const std::array pair{Part{"pair", both, moved({0, 1, 0})}};
  const Scene nested = assembled(pair).value();
  const int node = nested.nodes->find("b");
  ASSERT_GE(node, 0);
  EXPECT_EQ(nested.mesh->positions[3], glm::vec3(5, 1, 0));
  const std::array<NodeTransform, 1> move{NodeTransform{node, moved({7, 0, 0})}};
  const Scene shifted = posed(nested, move).value();
  EXPECT_EQ(shifted.mesh->positions[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(shifted.mesh->positions[3], glm::vec3(7, 1, 0));
  EXPECT_EQ(shifted.lights[0].position, glm::vec3(0, 1, 2));
  EXPECT_EQ(shifted.lights[1].position, glm::vec3(7, 1, 2));
}

// A mirrored node's triangles turn around, so that what is inside of glass stays inside.
TEST(Posed, MirroredNodesTurnTheirTriangles) {
  const Scene part = one_triangle();
  const std::array parts{Part{"a", part}};
  const Scene scene = assembled(parts).value();
  const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), {-1, 1, 1});
  const std::array<NodeTransform, 1> away{NodeTransform{0, mirror}}, back{NodeTransform{0, glm::mat4(1.0f)}};
  const Scene mirrored = posed(scene, away).value();
  EXPECT_EQ(mirrored.mesh->triangles[0], glm::uvec3(0, 2, 1));
  EXPECT_EQ(posed(mirrored, back).value().mesh->triangles[0], glm::uvec3(0, 1, 2));
  const std::array from_mirrored{Part{"a", part, mirror}};
  EXPECT_EQ(assembled(from_mirrored).value().mesh->triangles[0], glm::uvec3(0, 2, 1));
}

// Also where a determinant is no float.
TEST(Posed, NormalsAndSidesAreKeptAtAnyScale) {
  const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, 3));
  const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.5f, glm::vec3(0, 1, 0));
  const glm::vec3 expected = Placement(turned).normal(normal);
  for (const float scale : {1e-18f, 1e-13f, 1e-3f, 3.0f, 1e8f, 1e13f}) {
    const Placement placement(glm::scale(turned, glm::vec3(scale)));
    EXPECT_LT(glm::distance(placement.normal(normal), expected), 1e-6f) << scale;
    EXPECT_FALSE(placement.mirrors()) << scale;
    EXPECT_TRUE(Placement(glm::scale(turned, {-scale, scale, scale})).mirrors()) << scale;
  }
}

TEST(Posed, SaysWhatItCannotMove) {
  const Scene soup = one_triangle();
  const std::array<NodeTransform, 1> none{NodeTransform{3, glm::mat4(1.0f)}};
  EXPECT_NE(posed(soup, none).error().message().find("no nodes"), std::string::npos);
  const std::array parts{Part{"a", soup}};
  const Scene scene = assembled(parts).value();
  EXPECT_EQ(posed(scene, none).error().what, "there is no node 3");
  const std::array<NodeTransform, 1> lost{NodeTransform{0, glm::mat4(std::nanf(""))}};
  EXPECT_FALSE(posed(scene, lost));
}

template <class S>
concept CanBePart = requires(S&& scene) {
  Part{std::string(), std::forward<S>(scene)};
};
static_assert(CanBePart<Scene&> && CanBePart<const Scene&>);
static_assert(!CanBePart<Scene> && !CanBePart<const Scene>, "a part of a temporary scene would dangle");

TEST(Nodes, AMillionNodesDeep) {
  constexpr int kDeep = 1'000'000;
  NodeTree tree;
  for (int n = 0; n < kDeep; ++n) tree.nodes.push_back({"", n - 1, moved({1, 0, 0}), 0, 0, 0, 0});
  EXPECT_EQ(glm::vec3(tree.world_from(kDeep - 1)[3]), glm::vec3(kDeep, 0, 0));
  EXPECT_EQ(glm::vec3(tree.world_from(0)[3]), glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace pinocchio
