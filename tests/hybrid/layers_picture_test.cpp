// Layers for data sets: nodes, materials, primitives, motion and coverage.
#include <cmath>

#include "pinocchio/batch.h"
#include "pinocchio/extract.h"
#include "pinocchio/nodes.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kLayerSize{100, 100};
constexpr std::size_t kPixels = 10000;

Scene square(float half, std::uint32_t material = 0) {
  MeshData mesh;
  mesh.materials.resize(2);
  add_triangle(mesh, {-half, -half, 0}, {half, -half, 0}, {half, half, 0});
  add_triangle(mesh, {-half, -half, 0}, {half, half, 0}, {-half, half, 0});
  for (std::uint32_t& m : mesh.triangle_materials) m = material;
  return Scene(std::move(mesh));
}

// A small square before a large one, seen by a camera of 90 degrees whose pixel is 0.1 wide at z = 0.
Scene two_squares() {
  const Scene behind = square(4.0f, 0), before = square(1.0f, 1);
  const std::vector<Part> parts{
      {"behind", behind, glm::mat4(1.0f)},
      {"before", before, glm::mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 1, 1})}};
  Scene scene = assembled(parts).value();
  scene.cameras = {{"c", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 90.0f}};
  scene.lights = {point_light({0, 0, 9})};
  return scene;
}

struct Layers {
  std::vector<std::uint32_t> ids = std::vector<std::uint32_t>(kPixels), objects = ids, materials = ids,
                             primitives = ids;
  std::vector<glm::vec2> motion = std::vector<glm::vec2>(kPixels);

  FrameArrays arrays() {
    FrameArrays to;
    to.ids = ids.data();
    to.objects = objects.data();
    to.materials = materials.data();
    to.primitives = primitives.data();
    to.motion = motion.data();
    return to;
  }
};

// By the tile queue, and picture by picture.
std::vector<Settings> both_ways() {
  return {by({{"mode", "raytrace"}}), by({{"design", "1"}})};
}

Layers draw(const Scene& scene, const MotionTo& motion, const Settings& settings) {
  Engine engine;
  Layers layers;
  const auto done =
      render_many(engine, scene, scene.cameras, kLayerSize, settings, layers.arrays(), nullptr, {&motion, 1});
  EXPECT_TRUE(done);
  return layers;
}

TEST(DataLayers, NameWhatTrianglesBelongTo) {
  const Scene scene = two_squares();
  for (const Settings& settings : both_ways()) {
    const Layers seen = draw(scene, {nullptr, scene.cameras.front()}, settings);
    const std::size_t middle = 50 * 100 + 50, edge = 50 * 100 + 20, outside = 50 * 100 + 2;
    EXPECT_EQ(scene.nodes->nodes[seen.objects[middle]].name, "before");
    EXPECT_EQ(scene.nodes->nodes[seen.objects[edge]].name, "behind");
    EXPECT_EQ(scene.mesh->triangle_materials[seen.ids[middle]], seen.materials[middle]);
    EXPECT_NE(seen.materials[middle], seen.materials[edge]);
    EXPECT_LT(seen.primitives[middle], 2u);
    EXPECT_EQ(seen.ids[middle],
              seen.primitives[middle] + scene.nodes->nodes[seen.objects[middle]].first_triangle);
    for (const auto* layer : {&seen.objects, &seen.materials, &seen.primitives})
      EXPECT_EQ((*layer)[outside], kNoTriangle);
  }
}

TEST(DataLayers, MotionIsPixelsToTheOtherFrame) {
  const Scene scene = two_squares();
  const int before = scene.nodes->find("before");
  const NodeTransform move{before, glm::mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.4f, 0.8f, 1, 1})};
  const Scene moved = posed(scene, {&move, 1}).value();
  const std::size_t middle = 50 * 100 + 50, edge = 50 * 100 + 20, outside = 50 * 100 + 2;
  for (const Settings& settings : both_ways()) {
    // Nothing moves: exactly 0.
    for (const glm::vec2& motion : draw(scene, {nullptr, scene.cameras.front()}, settings).motion)
      EXPECT_EQ(motion, glm::vec2(0.0f));
    // A pixel of the small square, 4 before the camera, is 0.08 wide.
    const Layers of_node = draw(scene, {moved.mesh, scene.cameras.front()}, settings);
    EXPECT_NEAR(of_node.motion[middle].x, 5.0f, 1e-4f);
    EXPECT_NEAR(of_node.motion[middle].y, -10.0f, 1e-4f);
    EXPECT_EQ(of_node.motion[edge], glm::vec2(0.0f));
    EXPECT_EQ(of_node.motion[outside], glm::vec2(0.0f));
    // And back again, from the moved pose.
    const Layers back = draw(moved, {scene.mesh, scene.cameras.front()}, settings);
    EXPECT_NEAR(back.motion[middle - 1000 + 5].x, -5.0f, 1e-4f);
    // The camera moves, and looks away.
    Camera other = scene.cameras.front();
    other.eye.x += 0.5f;
    other.target.x += 0.5f;
    const Layers of_camera = draw(scene, {nullptr, other}, settings);
    EXPECT_NEAR(of_camera.motion[edge].x, -5.0f, 1e-4f);
    EXPECT_NEAR(of_camera.motion[middle].x, -6.25f, 1e-4f);
    other.target = {0.5f, 0.0f, 99.0f};
    EXPECT_TRUE(std::isnan(draw(scene, {nullptr, other}, settings).motion[middle].x));
  }
}

// A pane of alpha 0.25 before nothing, before a wall, and twice.
TEST(DataLayers, AlphaIsTheShareOfLightThatIsHeldBack) {
  Scene pane = square(1.0f), wall = square(1.0f);
  MeshData mesh = *pane.mesh;
  MaterialMaps& maps = make_maps(mesh, mesh.materials[0]);
  maps.alpha_mode = AlphaMode::blend;
  maps.alpha_factor = 0.25f;
  pane = Scene(std::move(mesh));
  const auto at = [](float x, float z) {
    return glm::mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {x, 0, z, 1});
  };
  const std::vector<Part> parts{{"one", pane, at(-3, 0)},
                                {"two a", pane, at(0, 0)},
                                {"two b", pane, at(0, 0.5f)},
                                {"pane", pane, at(3, 0.5f)},
                                {"wall", wall, at(3, 0)}};
  Scene scene = assembled(parts).value();
  scene.cameras = {{"c", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 90.0f}};
  scene.lights = {point_light({0, 0, 9})};
  for (const bool sky : {false, true}) {
    if (sky)
      scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({8, 4}, glm::vec3(0.5f)), "");
    Settings settings = by({{"mode", "raytrace"}});
    const FrameResult plain = draw_one(scene, {.settings = settings, .size = kLayerSize});
    EXPECT_EQ(plain.color.at(20, 50).a, 1.0f);
    settings.coverage = true;
    const FrameResult covered = draw_one(scene, {.settings = settings, .size = kLayerSize});
    EXPECT_NEAR(covered.color.at(20, 50).a, 0.25f, 1e-5f);
    EXPECT_NEAR(covered.color.at(50, 50).a, 1.0f - 0.75f * 0.75f, 1e-5f);
    EXPECT_EQ(covered.color.at(80, 50).a, 1.0f);
    EXPECT_EQ(covered.color.at(2, 2).a, 0.0f);
    for (std::size_t i = 0; i < kPixels; ++i)
      EXPECT_LT(glm::distance(glm::vec3(plain.color[i]), glm::vec3(covered.color[i])), 1e-6f);
  }
}

TEST(DataLayers, CoverageGoesToTheCpu) {
  const Scene scene = two_squares();
  Settings settings;
  settings.coverage = true;
  Engine engine(EngineOptions{.device = "no such device"});
  const auto picture = engine.render(scene, {.camera = scene.cameras.front(), .size = kLayerSize}, settings);
  ASSERT_TRUE(picture) << picture.error().message();
  EXPECT_FALSE(picture->settings.uses_gpu());
  settings.composite = Processor::gpu;
  EXPECT_NE(broken_rule(settings), nullptr);
}

TEST(Extracted, IsTheNodesTrianglesAlone) {
  const Scene scene = two_squares();
  const int before = scene.nodes->find("before");
  const Scene part = extracted(scene, {&before, 1}).value();
  ASSERT_EQ(part.mesh->triangles.size(), 2u);
  EXPECT_EQ(part.mesh->positions.size(), 4u + 2u);
  EXPECT_EQ(part.mesh->bounds().lo, glm::vec3(-1, -1, 1));
  EXPECT_EQ(part.nodes, nullptr);
  const int none = 99;
  EXPECT_FALSE(extracted(scene, {&none, 1}));
  EXPECT_FALSE(extracted(scene, {}));
}

}  // namespace
}  // namespace pinocchio
