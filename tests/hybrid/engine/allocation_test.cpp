// An allocation that fails, each in turn: one error, nothing lost, and the next picture is right.
#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <vector>

#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/pose_ahead.h"
#include "tests/support/draw.h"
#include "tests/support/failing_allocator.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{48, 40};
constexpr long kTrials = 100;

Settings alone() {
  Settings settings = by({{"mode", "raytrace"}});
  settings.threads = 2;
  return settings;
}

// What a test does with an engine, a tracer or the like of its own: begin() makes that and returns a call,
// which is made with a failing allocation and then again; it throws, or returns whether its result is right.
using Call = std::function<bool()>;

void expect_survives(const std::function<Call()>& begin) {
  int failed = 0, thrown = 0;  // an error beside the call need not reach it
  const auto whole = [&](long failing) {
    const Call call = begin();
    bool right = true;
    fail_allocation(failing);
    try {
      right = call();
    } catch (const std::bad_alloc&) {
      ++thrown;
    }
    if (failing > 0 && allocations_made >= failing_allocation) ++failed;
    fail_allocation(0);
    EXPECT_TRUE(right) << failing;
    EXPECT_TRUE(call()) << "after the failure of allocation " << failing;
  };
  whole(0);  // what a process keeps is made
  const long before = allocations_made;
  whole(0);
  const long all = allocations_made - before;
  for (long n = 1; n <= all; n += std::max(1L, all / kTrials)) {
    const long alive = blocks_alive;
    whole(n);
    EXPECT_EQ(blocks_alive, alive) << "after the failure of allocation " << n << " of " << all;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(failed, 20);
  EXPECT_GT(thrown, 0);
}

TEST(Allocation, OfATracer) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const std::vector<Ray> rays(100, Ray{{0.0f, 0.0f, 5.0f}, kInfinity, {0.1f, 0.05f, -1.0f}});
  std::vector<Hit> wanted(rays.size());
  Tracer(scene.mesh).closest_hits(rays, wanted);
  expect_survives([&]() -> Call {
    return [&] {
      BuildOptions options;
      options.threads = 2;
      std::vector<Hit> hits(rays.size());
      Tracer(scene.mesh, options).closest_hits(rays, hits);
      return hits == wanted;
    };
  });
}

TEST(Allocation, OfAPicture) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const View view{first_camera(scene), kSize};
  const FrameResult wanted = Engine({.backend = "none"}).render(scene, view, alone()).value();
  expect_survives([&]() -> Call {
    return [&, engine = std::make_shared<Engine>(EngineOptions{.backend = "none"})] {
      return same_pixels(engine->render(scene, view, alone()).value(), wanted);
    };
  });
}

TEST(Allocation, OfManyPictures) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const std::vector<Camera> cameras(3, first_camera(scene));
  const std::size_t pixels = kSize.x * kSize.y;
  const auto draw = [&](Engine& engine) {
    std::vector<glm::vec4> color(cameras.size() * pixels);
    std::vector<float> depth(color.size());
    FrameArrays to;
    to.color = color.data(), to.depth = depth.data();
    (void)render_many(engine, scene, cameras, kSize, alone(), to).value();
    return std::pair(color, depth);
  };
  Engine first({.backend = "none"});
  const auto wanted = draw(first);
  expect_survives([&]() -> Call {
    return [&, engine = std::make_shared<Engine>(EngineOptions{.backend = "none"})] {
      return draw(*engine) == wanted;
    };
  });
}

// In flight on the thread that poses ahead, too.
TEST(Allocation, OfPoses) {
  const Scene scene = load_or_die(source_path("scenes/windmill.glb"));
  const Settings settings = *resolve(alone(), analyze(scene));
  const auto wanted = at_time(scene, 0.5)->mesh->positions;
  expect_survives([&]() -> Call {
    return [&, poses = std::make_shared<PoseAhead>(scene)] {
      (void)poses->at(0.0, settings, 0.5).value();
      return poses->at(0.5, settings, 0.0)->scene.mesh->positions == wanted;
    };
  });
}

}  // namespace
}  // namespace pinocchio
