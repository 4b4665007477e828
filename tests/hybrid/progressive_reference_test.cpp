// The precise picture in the background, against the one made at once.
#include "hybrid/inspect/progressive_reference.h"

#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/compare/figures.h"
#include "core/compare/reference_error.h"
#include "core/reference/reference.h"
#include "core/trace/view/view_params.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{70, 50};  // tiles and squares cut at the edges

ReferenceView view_of(const Scene& scene) {
  return {scene, {first_camera(scene), kSize}, 4};
}

Image<glm::vec4> at_once(const ReferenceView& view) {
  Workers workers(2);
  return reference_render(view.scene, view.view, view.depth, workers, nullptr, view.options).color;
}

// Waits a moment between polls; ctest's time limit ends what never finishes.
Image<glm::vec4> finish(ProgressiveReference& reference) {
  for (;;) {
    const ProgressiveReference::Progress progress = reference.poll();
    if (progress.share == 1.0) return progress.color;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(ProgressiveReference, EndsAsThePictureMadeAtOnce) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  ReferenceView view = view_of(scene);
  for (const int threads : {1, 3}) {
    ProgressiveReference reference(threads);
    view = view_of(scene);
    reference.show(view);
    EXPECT_TRUE(std::ranges::equal(finish(reference).pixels(), at_once(view).pixels()));
    view.view.part = {{13, 7}, {50, 41}};
    view.view.jitter = {0.25f, -0.125f};
    reference.show(view);
    EXPECT_TRUE(std::ranges::equal(finish(reference).pixels(), at_once(view).pixels()));
    reference.show(view);  // again: it is there
    EXPECT_EQ(reference.poll().share, 1.0);
  }
}

// The window's reference is --precise's: by the remedy of the terminator and the filter that are set.
TEST(ProgressiveReference, FollowsTheOptions) {
  const Scene scene = load_or_die(source_path("scenes/terrace.glb"));
  ReferenceView view = view_of(scene);
  ProgressiveReference reference;
  reference.show(view);
  const Image<glm::vec4> usual = finish(reference);
  view.options.terminator = Terminator::off;
  view.options.texture_footprint = 0.0f;
  reference.show(view);
  const Image<glm::vec4> other = finish(reference);
  EXPECT_TRUE(std::ranges::equal(other.pixels(), at_once(view).pixels()));
  EXPECT_FALSE(std::ranges::equal(other.pixels(), usual.pixels()));
}

TEST(ProgressiveReference, GrowsFromSquaresOfExactPixels) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const ReferenceView view = view_of(scene);
  const Image<glm::vec4> exact = at_once(view);
  ProgressiveReference reference;
  reference.show(view);
  double last_share = 0.0;
  for (bool done = false; !done;) {
    const auto [color, share, changed] = reference.poll();
    done = share == 1.0;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(changed, share > last_share);
    last_share = share;
    ASSERT_EQ(color.size(), kSize);
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const glm::vec4& c = color.at(x, y);
        const auto from = [&](int step) { return exact.at(x - x % step, y - y % step); };
        ASSERT_TRUE(c == glm::vec4(0.0f) || c == from(8) || c == from(4) || c == from(2) || c == from(1));
      }
  }
}

TEST(ProgressiveReference, AnotherViewDropsTheOneBefore) {
  const Scene cornell = load_or_die(source_path("scenes/cornell")),
              lights = load_or_die(source_path("scenes/two-lights"));
  ProgressiveReference reference(2);
  ReferenceView view;
  for (int i = 0; i < 40; ++i) {
    view = view_of(i % 3 == 2 ? cornell : lights);
    view.view.camera.eye.x += 0.01f * static_cast<float>(i);
    reference.show(view);
    const auto [color, share, changed] = reference.poll();
    EXPECT_EQ(color.size(), kSize);
    EXPECT_LE(share, 1.0);
  }
  EXPECT_TRUE(std::ranges::equal(finish(reference).pixels(), at_once(view).pixels()));
  reference.stop();
  EXPECT_EQ(reference.poll().share, 0.0);
  reference.show(view);
  EXPECT_TRUE(std::ranges::equal(finish(reference).pixels(), at_once(view).pixels()));
}

TEST(ProgressiveReference, OtherLightsOnTheSameTriangles) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 5, 1})};
  ProgressiveReference reference;
  for (int i = 0; i < 4; ++i) {
    scene.lights.front().position.x = static_cast<float>(i);
    const ReferenceView view = view_of(scene);
    reference.show(view);
    EXPECT_TRUE(std::ranges::equal(finish(reference).pixels(), at_once(view).pixels()));
  }
}

TEST(ProgressiveReference, LetsGoOfScenesOnTheCallersThread) {
  ProgressiveReference reference;
  const Scene first = load_or_die(source_path("scenes/cornell")),
              second = load_or_die(source_path("scenes/two-lights"));
  reference.show(view_of(first));
  reference.show(view_of(second));
  finish(reference);
  while (first.mesh.use_count() > 1) (void)reference.poll();  // as soon as the background is through with it
  EXPECT_GT(second.mesh.use_count(), 1);
}

TEST(ProgressiveReference, EndsInTheMiddleOfATreeOrAPicture) {
  const Scene soup = random_soup(200000, 0.02f, 1);
  ReferenceView view = view_of(soup);
  view.view.size = {800, 600};
  for (int i = 0; i < 5; ++i) {
    ProgressiveReference reference(2);
    reference.show(view);
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * i));
  }
  SUCCEED();
}

// The 19th field of a thread's stat is its nice value.
TEST(ProgressiveReference, GivesWayToOtherThreads) {
  ProgressiveReference reference(2);
  reference.show(view_of(plate_over_floor()));
  finish(reference);
  const int own = getpriority(PRIO_PROCESS, 0);
  if (own > 9) GTEST_SKIP() << "the test itself runs at a low priority";
  int lowered = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream in(task.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(in)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string field;
    for (int i = 3; i <= 19; ++i) fields >> field;
    lowered += std::stoi(field) >= own + 10;
  }
  EXPECT_EQ(lowered, 2);
}

TEST(ReferenceErrors, AreTheFiguresAndTheHeat) {
  Workers workers(2);
  const ReferenceView view = view_of(load_or_die(source_path("scenes/two-lights")));
  const Image<glm::vec4> exact = at_once(view);
  for (const ErrorMap map : {ErrorMap::flip, ErrorMap::difference}) {
    const ReferenceError none = error_against(exact, exact, map, workers);
    EXPECT_EQ(none.rmse, 0.0);
    EXPECT_EQ(none.mean_flip, 0.0);
    for (const glm::u8vec3& heat : none.heat.pixels()) ASSERT_LT(heat.r + heat.g + heat.b, 12);
  }
  Image<glm::vec4> off = exact;
  off.at(20, 30) += glm::vec4(1.0f, 0.5f, 0.0f, 0.0f);
  off.at(40, 10).g = std::numeric_limits<float>::quiet_NaN();
  const ReferenceError some = error_against(off, exact, ErrorMap::difference, workers);
  const double nan_error = static_cast<double>(exact.at(40, 10).g);
  EXPECT_NEAR(some.rmse, std::sqrt((1.25 + nan_error * nan_error) / (3.0 * kSize.x * kSize.y)), 1e-6);
  EXPECT_GT(some.mean_flip, 0.0);
  const glm::u8vec3 heat = some.heat.at(20, 30);
  EXPECT_GT(heat.r + heat.g + heat.b, 500);
}

}  // namespace
}  // namespace pinocchio
