// Skins and morph targets, against closed forms.
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/moving_gltf.h"

namespace pinocchio {
namespace {

TEST(Skin, FollowsItsJoints) {
  Moving m = skinned();
  // The second joint turns by 90 degrees around z, about its own place (1, 1, 0).
  m.animate(
      2, "rotation", {0, 1},
      m.floats({0, 0, 0, 1, 0, 0, std::sin(glm::quarter_pi<float>()), std::cos(glm::quarter_pi<float>())},
               "VEC4"));
  Warnings warnings;
  const Scene scene = load(m.json, &warnings).value();
  EXPECT_TRUE(warnings.empty());
  for (int v = 0; v < 3; ++v)
    expect_near(scene.mesh->positions[static_cast<std::size_t>(v)], glm::vec3(v == 1, v == 2, 0));  // bound
  const Scene bent = at(scene, 1);
  expect_near(bent.mesh->positions[0], {0, 0, 0});
  expect_near(bent.mesh->positions[1], {2, 1, 0});      // (1,0) about (1,1): offset (0,-1) becomes (1,0)
  expect_near(bent.mesh->positions[2], {0.5, 0.5, 0});  // halfway between (0,1) and (1,0)
  const std::array<NodeTransform, 1> moved{NodeTransform{2, glm::translate(glm::mat4(1.0f), {0, 3, 0})}};
  expect_near(posed(scene, moved).value().mesh->positions[1], {1, 2, 0});
}

TEST(Skin, ReadsNormalisedWeightsAndASecondSet) {
  Moving m = skinned();
  m.primitive()["attributes"]["WEIGHTS_0"] =
      m.bytes({255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0}, true);
  m.primitive()["attributes"]["JOINTS_1"] = m.bytes({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, false);
  m.primitive()["attributes"]["WEIGHTS_1"] =
      m.bytes({0, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0, 0, 0, 0, 0}, true);
  const std::array<NodeTransform, 1> moved{NodeTransform{2, glm::translate(glm::mat4(1.0f), {0, 3, 0})}};
  const Scene scene = posed(load_good(m.json), moved).value();
  expect_near(scene.mesh->positions[1], {1, 2, 0});
  expect_near(scene.mesh->positions[2], {0, 1 + 0.8 * 2, 0});
}

TEST(Morph, AddsTargetsByTheirWeights) {
  Moving m = morphed();
  expect_near(load_good(m.json).mesh->positions[0], {0, 0.5, 0.5});  // the mesh's own weights
  m.json["nodes"][0]["weights"] = {1.0, 0.0};
  expect_near(load_good(m.json).mesh->positions[0], {0, 0, 1});  // the node's go first
  m.animate(0, "weights", {0, 2}, m.floats({0, 0, 1, 0.5}, "SCALAR"));
  const Scene scene = load_good(m.json), half = at(scene, 1);
  expect_near(half.mesh->positions[0], {0, 0.5, 0.5});
  expect_near(half.mesh->positions[1], {2, 0, 0});
  const std::array<NodeWeights, 1> weights{NodeWeights{0, {0.0f, 2.0f}}};
  expect_near(posed(scene, {}, weights).value().mesh->positions[0], {0, 4, 0});
}

TEST(Morph, ComesBeforeTheSkin) {
  Moving m = skinned();
  m.primitive()["targets"] = {{{"POSITION", m.floats({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  m.json["meshes"][0]["weights"] = {1};
  m.json["nodes"][2]["rotation"] = {0, 0, std::sin(glm::quarter_pi<float>()),
                                    std::cos(glm::quarter_pi<float>())};
  expect_near(load_good(m.json).mesh->positions[1], {2, 2, 0});  // (2,0) about (1,1)
}

// A sparse target moves only what it names; normals follow their targets.
TEST(Morph, ReadsSparseTargetsAndNormals) {
  Moving m;
  m.primitive()["attributes"]["NORMAL"] = m.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int index = m.add(std::vector<std::uint16_t>{2}, "SCALAR", 5123, 1),
            value = m.floats({0, 0, 7}, "VEC3");
  const auto view = [&](int accessor) {
    return m.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
  };
  m.json["accessors"].push_back({{"componentType", 5126},
                                 {"count", 4},
                                 {"type", "VEC3"},
                                 {"sparse",
                                  {{"count", 1},
                                   {"indices", {{"bufferView", view(index)}, {"componentType", 5123}}},
                                   {"values", {{"bufferView", view(value)}}}}}});
  const int sparse = static_cast<int>(m.json["accessors"].size()) - 1;
  m.primitive()["targets"] = {
      {{"POSITION", sparse}, {"NORMAL", m.floats({1, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  m.json["meshes"][0]["weights"] = {1};
  const Scene scene = load_good(m.json);
  expect_near(scene.mesh->positions[0], {0, 0, 0});
  expect_near(scene.mesh->positions[2], {0, 1, 7});
  expect_near(scene.mesh->normals[0], {1, 0, 0});
  expect_near(scene.mesh->normals[1], {0, 0, 1});
}

}  // namespace
}  // namespace pinocchio
