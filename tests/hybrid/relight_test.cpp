// Lights changed while frames are in flight, against a scene prepared with them from the start.
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{160, 120};

using RelightTest = FramesTest;
INSTANTIATE_TEST_SUITE_P(Backends, RelightTest, kBackends, backend_name);

// One that moved, one that is weaker, one that casts no more, one more.
std::vector<std::vector<Light>> changes_of(const std::vector<Light>& lights) {
  std::vector<std::vector<Light>> changes(4, lights);
  changes[0].front().position += glm::vec3(0.4f, 0.1f, -0.3f);
  changes[1].front().intensity *= 0.25f;
  changes[2].front().casts_shadow = false;
  changes[3].push_back(lights.front());
  changes[3].back().position.x += 1.0f;
  changes[3].back().casts_shadow = true;
  return changes;
}

Needs recounted(const Scene& scene, Needs needs) {
  recount_lights(scene, needs);
  return needs;
}

TEST_P(RelightTest, IsTheSceneAsIfPreparedWithThoseLights) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const auto before = prepare(scene);
  const Needs needs = take_census(scene);
  std::vector<FrameRequest> relit, fresh;
  for (const std::vector<Light>& lights : changes_of(scene.lights)) {
    const auto changed = std::make_shared<const PreparedScene>(before, lights);
    EXPECT_EQ(changed->tracer, before->tracer);
    EXPECT_EQ(changed->scene.mesh, before->scene.mesh);
    Scene other = scene;
    other.lights = lights;
    const Plan plan = *make_plan(take_census(other), {});
    EXPECT_EQ(*make_plan(recounted(changed->scene, needs), {}), plan);
    relit.push_back(request(before, plan_of(scene), kSize));  // old and new in flight at once
    fresh.push_back(relit.back());
    relit.push_back(request(changed, plan, kSize));
    fresh.push_back(request(prepare(other), plan, kSize));
  }
  std::vector<Image<glm::vec4>> expected;
  draw(fresh, Exchange::sync, [&](Flight& frame) { expected.push_back(read(frame.picture.target)); });
  std::size_t delivered = 0;
  draw(relit, Exchange::pipelined, [&](Flight& frame) {
    ASSERT_LT(delivered, expected.size());
    EXPECT_TRUE(std::ranges::equal(read(frame.picture.target).pixels(), expected[delivered].pixels()))
        << delivered;
    ++delivered;
  });
  EXPECT_EQ(delivered, expected.size());
  for (std::size_t i = 1; i < expected.size(); i += 2)
    EXPECT_FALSE(std::ranges::equal(expected[i].pixels(), expected[0].pixels())) << i;
}

}  // namespace
}  // namespace pinocchio
