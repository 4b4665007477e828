#include "pinocchio/pose_ahead.h"

#include <algorithm>
#include <string_view>
#include <thread>

#include "hybrid/settings/resolve.h"
#include "scenes/generator/random.h"
#include "scenes/generator/scenes.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr std::size_t kRays = 20000;

// From a ball about the scene to points of its triangles.
std::vector<Ray> rays_at(const Mesh& mesh) {
  std::vector<Ray> rays(kRays);
  Random random(11);
  const auto corner = [&] {
    const auto i =
        static_cast<std::size_t>(random.between(0.0f, 1.0f) * static_cast<float>(mesh.triangles.size() - 1));
    return mesh.positions[mesh.triangles[i].x];
  };
  for (Ray& ray : rays) {
    ray.origin = corner() + glm::vec3(random.between(-20.0f, 20.0f), random.between(0.0f, 20.0f),
                                      random.between(-20.0f, 20.0f));
    ray.direction = corner() - ray.origin;
  }
  return rays;
}

std::vector<Hit> hits_of(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  tracer.closest_hits(rays, hits);
  return hits;
}

// Trees made ahead, whatever was asked for before, and trees built of each time's pose alone: to the last
// bit.
TEST(PoseAhead, TreesAreThoseThatAreBuiltAnew) {
  const Scene scene = load_or_die(source_path("scenes/windmill.glb"));
  for (const SplitRule rule : {SplitRule::sah, SplitRule::object_median}) {
    Settings wanted;
    wanted.tree = rule;
    const Settings settings = *resolve(wanted, analyze(scene));
    PoseAhead ahead(scene);
    std::vector<Hit> before;
    constexpr double kTimes[] = {0.0, 0.04, 0.08, 1.3, 0.5, 0.54};
    for (std::size_t i = 0; i < std::size(kTimes); ++i) {
      // One pose is promised and not asked for.
      const double next = i == 2 ? 0.12 : kTimes[std::min(i + 1, std::size(kTimes) - 1)];
      const Expected<PoseAhead::Pose> pose = ahead.at(kTimes[i], settings, next);
      ASSERT_TRUE(pose) << pose.error().message();
      const Scene alone = *at_time(scene, kTimes[i]);
      ASSERT_EQ(pose->scene.mesh->positions, alone.mesh->positions);
      const std::vector<Ray> rays = rays_at(*alone.mesh);
      const std::vector<Hit> hits = hits_of(*pose->tracer, rays);
      EXPECT_EQ(hits, hits_of(Tracer(alone.mesh), rays)) << kTimes[i];
      EXPECT_GT(std::ranges::count_if(hits, &Hit::valid), static_cast<long>(kRays / 2));
      EXPECT_NE(hits, before);
      before = hits;
    }
  }
}

// A tree that takes long, for poses of any time.
const Scene& forest() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static const Scene scene = make_forest(60'000);
#else
  static const Scene scene = make_forest(500'000);
#endif
  return scene;
}

void wait_for_build(const Progress& progress) {
  while (std::string_view(progress.phase()) != "build" || progress.fraction() == 0.0)
    std::this_thread::yield();
}

// By the part that was built, not by a clock.
TEST(PoseAhead, WhatIsNotWantedAnyMoreIsNotBuiltToItsEnd) {
  const Settings settings = *resolve(Settings{}, analyze(forest()));
  std::shared_ptr<const Progress> dropped, unwanted, whole;
  Progress of_all;
  {
    PoseAhead ahead(forest(), &of_all);
    ASSERT_TRUE(ahead.at(0.0, settings, 1.0));
    unwanted = ahead.next_progress();
    wait_for_build(*unwanted);
    ASSERT_TRUE(ahead.at(2.0, settings, 3.0));  // another than the one that was announced
    EXPECT_LT(unwanted->fraction(), 1.0);
    dropped = ahead.next_progress();
    wait_for_build(*dropped);
  }
  EXPECT_LT(dropped->fraction(), 1.0);
  {
    PoseAhead ahead(forest(), &of_all);
    ASSERT_TRUE(ahead.at(0.0, settings, 1.0));
    whole = ahead.next_progress();
    wait_for_build(*whole);
    of_all.cancel();
    EXPECT_THROW((void)ahead.at(1.0, settings), Cancelled);
  }
  EXPECT_LT(whole->fraction(), 1.0);
}

// The pose that is made while it is waited for, too.
TEST(PoseAhead, APoseThatIsWaitedForIsCancelled) {
  const Settings settings = *resolve(Settings{}, analyze(forest()));
  Progress progress;
  std::jthread watcher([&] {
    wait_for_build(progress);
    progress.cancel();
  });
  EXPECT_THROW((void)PoseAhead(forest(), &progress).at(0.0, settings), Cancelled);
  EXPECT_LT(progress.fraction(), 1.0);
}

}  // namespace
}  // namespace pinocchio
