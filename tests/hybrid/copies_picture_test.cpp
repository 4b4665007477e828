// Copies of a mesh that share its tree, drawn beside the same scene in one tree: every pixel is the same.
#include "pinocchio/nodes.h"
#include "tests/support/copies.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

// The scene as if no node placed another's mesh.
Scene without_copies(Scene scene) {
  RestPose rest = *scene.nodes->rest;
  rest.copies.clear();
  NodeTree tree = *scene.nodes;
  tree.rest = std::make_shared<const RestPose>(std::move(rest));
  scene.nodes = std::make_shared<const NodeTree>(std::move(tree));
  return scene;
}

// Poses in which a node moves thrice, and is flattened; another mirrors itself.
std::vector<std::vector<NodeTransform>> poses_of(const Scene& scene) {
  const int instances = static_cast<int>(scene.nodes->nodes.size()) - 1;
  const glm::mat4 at = scene.nodes->nodes[4].local, all = scene.nodes->nodes.back().local;
  const auto shift = [](float x) { return glm::translate(glm::mat4(1.0f), {x, 0.5f * x, 0}); };
  return {{},
          {{4, shift(0.5f) * at}},
          {{4, shift(1.0f) * at}, {instances, glm::scale(all, {1, 1, -1})}},
          {{4, shift(1.5f) * at}, {instances, shift(-0.7f) * all}},
          {{4, glm::scale(at, {1, 0, 1})}}};
}

TEST(CopiesPicture, IsThatOfOneTree) {
  Scene shared = load_copies();
  shared.lights = {point_light({6, 9, 7}), point_light({-8, 3, 2})};
  const Scene copied = without_copies(shared);
  const Camera camera{"", {1, 2, 14}, {0, 0, 0}, {0, 1, 0}, 45.0f};
  for (const char* mode : {"raytrace", "hybrid"}) {
    Settings settings = by({{"mode", mode}});
    settings.threads.fill(2);
    Engine engine({.backend = "egl"}), beside({.backend = "egl"});
    for (const std::vector<NodeTransform>& moves : poses_of(shared)) {
      const View view{camera, {240, 180}};
      const FrameResult picture = engine.render(posed(shared, moves).value(), view, settings).value();
      const FrameResult expected = beside.render(posed(copied, moves).value(), view, settings).value();
      EXPECT_TRUE(same_pixels(picture, expected)) << mode;
      EXPECT_TRUE(std::ranges::any_of(picture.reflection.pixels(),
                                      [](const glm::vec3& light) { return light != glm::vec3(0.0f); }));
    }
  }
}

}  // namespace
}  // namespace pinocchio
