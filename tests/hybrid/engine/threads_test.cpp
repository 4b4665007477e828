// Threads that the system does not start: the work is done by those that there are, with the same result.
#include "pinocchio/threads.h"

#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "core/parallel/start_thread.h"
#include "core/parallel/workers.h"
#include "hybrid/inspect/progressive_reference.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/pose_ahead.h"
#include "tests/support/draw.h"
#include "tests/support/limited_threads.h"

namespace pinocchio {
namespace {

std::vector<std::string> lines;  // said of missing threads

class Threads : public testing::Test {
 protected:
  void SetUp() override {
    lines.clear();
    set_thread_warning([](const char* line) { lines.emplace_back(line); });
  }
  void TearDown() override {
    threads_left = std::numeric_limits<int>::max();
    set_thread_warning(nullptr);
  }

  static Settings alone() {
    Settings settings = by({{"mode", "raytrace"}});
    settings.threads = 4;
    return settings;
  }
};

TEST_F(Threads, WorkersGoOnWithThoseThatStart) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (const int left : {0, 1, 2, 5}) {
    threads_left = left;
    Workers workers(6);
    EXPECT_EQ(workers.count(), left == 5 ? 6 : std::min(left + 1, cores));
    for (const std::size_t n : {0u, 1u, 3u, 1000u}) {
      std::vector<std::atomic<int>> done(n);
      workers.for_each(n, [&](std::size_t i) { ++done[i]; });
      for (const std::atomic<int>& d : done) EXPECT_EQ(d, 1);
    }
    EXPECT_THROW(workers.for_each(100, [](std::size_t) { throw std::runtime_error("a body's"); }),
                 std::runtime_error);
  }
  ASSERT_EQ(lines.size(), 1u);  // once a process
  EXPECT_NE(lines[0].find("only 1 of 6 threads"), std::string::npos) << lines[0];
}

TEST_F(Threads, WhatIsDoneAsideIsDoneHere) {
  threads_left = 0;
  const auto here = std::this_thread::get_id();
  EXPECT_EQ(run_aside(5, [] { return std::this_thread::get_id(); }).get(), here);
  EXPECT_THROW(run_aside(0, [] { throw std::runtime_error("its own"); }).get(), std::runtime_error);
  threads_left = 1;
  EXPECT_NE(run_aside(5, [] { return std::this_thread::get_id(); }).get(), here);
  EXPECT_EQ(lines.size(), 1u);
}

// Engine's tracing thread, the pool and the trees' workers, from the first call to the last.
TEST_F(Threads, PicturesAreTheSame) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const View view{first_camera(scene), {96, 64}};
  const FrameResult wanted = Engine({.backend = "none"}).render(scene, view, alone()).value();
  for (const int left : {0, 1, 3, 7}) {
    threads_left = left;
    Engine engine({.backend = "none"});
    EXPECT_TRUE(same_pixels(engine.render(scene, view, alone()).value(), wanted)) << left;
    const FrameResult again =
        engine.render(load_or_die(source_path("scenes/cornell")), view, alone()).value();
    EXPECT_TRUE(same_pixels(again, wanted)) << left;
    std::vector<glm::vec4> color(2 * 96 * 64);
    FrameArrays to;
    to.color = color.data();
    ASSERT_TRUE(render_many(engine, scene, std::vector{view.camera, view.camera}, view.size, alone(), to));
    EXPECT_TRUE(std::equal(color.begin(), color.begin() + 96 * 64, color.begin() + 96 * 64));
  }
  EXPECT_EQ(lines.size(), 1u);
}

TEST_F(Threads, PosesAreTheSame) {
  const Scene scene = load_or_die(source_path("scenes/windmill.glb"));
  const Settings settings = *resolve(alone(), analyze(scene));
  threads_left = 0;
  PoseAhead ahead(scene);
  for (const double time : {0.0, 0.5, 1.0}) {
    const Expected<PoseAhead::Pose> pose = ahead.at(time, settings, time + 0.5);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->scene.mesh->positions, at_time(scene, time)->mesh->positions);
  }
}

TEST_F(Threads, AReferenceWithoutItsThreadIsAnError) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  threads_left = 0;
  ProgressiveReference reference;
  EXPECT_EQ(reference.poll().share, 0.0);  // nothing is asked for
  reference.show({scene, {first_camera(scene), {32, 24}}, 4});
  EXPECT_THROW((void)reference.poll(), std::runtime_error);
  reference.stop();
}

}  // namespace
}  // namespace pinocchio
