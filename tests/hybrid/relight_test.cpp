// Lights changed while frames are in flight, against a scene that had them from the start.
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kRelitSize{160, 120};

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

SceneStats recounted(const Scene& scene, SceneStats stats) {
  recount_lights(scene, stats);
  return stats;
}

TEST_P(RelightTest, IsTheSceneAsIfItHadThoseLightsFromTheStart) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const SceneStats stats = analyze(scene);
  const FrameRequest before = request(scene, settings_for(scene), kRelitSize);
  std::vector<FrameRequest> relit, fresh;
  for (const std::vector<Light>& lights : changes_of(scene.lights)) {
    FrameRequest changed = before;
    changed.scene.lights = lights;
    changed.settings = settings_for(changed.scene);
    EXPECT_EQ(*resolve({}, recounted(changed.scene, stats)), *resolve({}, analyze(changed.scene)));
    Scene other = load_or_die(source_path("scenes/two-lights"));
    other.lights = lights;
    relit.push_back(before);  // old and new in flight at once
    fresh.push_back(relit.back());
    relit.push_back(changed);
    fresh.push_back(request(other, changed.settings, kRelitSize));
  }
  std::vector<Image<glm::vec4>> expected;
  draw(fresh, Exchange::sync, [&](Frame& frame) { expected.push_back(read(frame.texture())); });
  std::size_t delivered = 0;
  std::shared_ptr<const GpuMesh> mesh;
  draw(relit, Exchange::pipelined, [&](Frame& frame) {
    ASSERT_LT(delivered, expected.size());
    EXPECT_TRUE(same(read(frame.texture()), expected[delivered])) << delivered;
    EXPECT_EQ(frame.request().scene.mesh, scene.mesh);
    EXPECT_TRUE(!mesh || mesh == frame.slot().mesh) << "geometry was copied";
    mesh = frame.slot().mesh;
    ++delivered;
  });
  EXPECT_EQ(delivered, expected.size());
  for (std::size_t i = 1; i < expected.size(); i += 2)
    EXPECT_FALSE(std::ranges::equal(expected[i].pixels(), expected[0].pixels())) << i;
}

}  // namespace
}  // namespace pinocchio
