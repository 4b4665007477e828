// Long work ends soon after it is cancelled, leaves nothing behind, and tells truly how far it is.
#include "pinocchio/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

#include "core/base/clock.h"
#include "core/reference/reference.h"
#include "pinocchio/exr.h"
#include "pinocchio/load.h"
#include "pinocchio/save.h"
#include "pinocchio/tracer.h"
#include "scenes/generator/scenes.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

// Cancels the work once its phase has that name. Returns the processor time that the work used after that:
// the clock would also count how long it waited for a core.
double seconds_after_cancel(const std::string& phase, const std::function<void(Progress*)>& work) {
  Progress progress;
  double cancelled_s = 0.0;
  std::jthread watcher([&](const std::stop_token& stop) {
    while (!stop.stop_requested() && progress.phase() != phase) std::this_thread::yield();
    cancelled_s = processor_s();
    progress.cancel();
  });
  bool cancelled = false;
  try {
    work(&progress);
  } catch (const Cancelled&) {
    cancelled = true;
  }
  const double end_s = processor_s();
  watcher.request_stop();
  watcher.join();
  EXPECT_TRUE(cancelled) << phase;
  return end_s - cancelled_s;
}

// What fractions a watcher sees, sorted as they came; the last is the one at the end.
std::vector<double> fractions(const std::function<void(Progress*)>& work) {
  Progress progress;
  std::vector<double> seen;
  std::jthread watcher([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      seen.push_back(progress.fraction());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  work(&progress);
  watcher.request_stop();
  watcher.join();
  seen.push_back(progress.fraction());
  return seen;
}

const Scene& forest() {
  static const Scene scene = make_forest(500'000);
  return scene;
}

// Half the processor time that building the forest's tree takes: slow machines and sanitizers have more.
double soon_s() {
  static const double kBuild_s = [] {
    const double begin_s = processor_s();
    const Tracer whole(forest().mesh);
    return processor_s() - begin_s;
  }();
  return std::max(1.0, 0.5 * kBuild_s);
}

BuildOptions watched(Progress* progress) {
  BuildOptions options;
  options.progress = progress;
  return options;
}

TEST(Progress, NobodyNeedsOne) {
  throw_if_cancelled(nullptr);
  begin_phase(nullptr, "work", 1.0);
  advance(nullptr);
}

TEST(Progress, TheFractionIsOfThePhase) {
  Progress progress;
  EXPECT_EQ(progress.fraction(), 0.0);
  progress.begin("read", 4.0);
  progress.advance(1.0);
  EXPECT_STREQ(progress.phase(), "read");
  EXPECT_EQ(progress.fraction(), 0.25);
  progress.advance(5.0);
  EXPECT_EQ(progress.fraction(), 1.0);
  progress.begin("build", 1.0);
  EXPECT_EQ(progress.fraction(), 0.0);
}

TEST(Progress, ABuildEndsSoon) {
  EXPECT_LT(seconds_after_cancel("build", [](Progress* p) { Tracer(forest().mesh, watched(p)); }), soon_s());
}

TEST(Progress, ABuildTellsTrulyHowFarItIs) {
  const std::vector<double> seen = fractions([](Progress* p) { Tracer(forest().mesh, watched(p)); });
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_NEAR(seen.back(), 1.0, 1e-6);
  EXPECT_GT(std::ranges::count_if(seen, [](double f) { return f > 0.1 && f < 0.9; }), 3);
}

TEST(Progress, TheReferenceEndsSoon) {
  Workers workers;
  const View view{forest().cameras.front(), {640, 480}};
  const auto draw = [&](Progress* p) {
    begin_phase(p, "render", 1.0);
    (void)reference_render(forest(), view, 8, workers, p);
  };
  EXPECT_LT(seconds_after_cancel("render", draw), soon_s());
}

TEST(Progress, GeneratingEndsSoon) {
  EXPECT_LT(seconds_after_cancel("generate",
                                 [](Progress* p) {
                                   (void)make_procedural("forest", {50'000'000, p});
                                 }),
            soon_s());
}

TEST(Progress, ReadingAndWritingScenesEndSoonAndLeaveNothing) {
  for (const char* name : {"forest.obj", "forest.gltf", "forest.glb"}) {
    const std::filesystem::path file = own_file(name);
    EXPECT_LT(seconds_after_cancel("write", [&](Progress* p) { save_scene(forest(), file, p); }), soon_s());
    EXPECT_FALSE(std::filesystem::exists(file)) << file;
    for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    save_scene(forest(), file);
    for (const char* phase : {"read", "mesh"})
      EXPECT_LT(seconds_after_cancel(phase, [&](Progress* p) { (void)load_scene(file, nullptr, p); }),
                soon_s())
          << file << " " << phase;
  }
}

TEST(Progress, AnExrIsWrittenWholeOrNotAtAll) {
  const std::filesystem::path file = own_file("cancelled.exr");
  ExrFile exr;
  exr.display_size = {4096, 2048};
  exr.data_window = {{0, 0}, exr.display_size};
  std::vector<float> values(4096 * 2048);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * 7919 % 104729);
  exr.channels = {{"Y", ExrChannel::Type::real, values, {}}};
  EXPECT_LT(seconds_after_cancel("write", [&](Progress* p) { write_exr(file, exr, p); }), soon_s());
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace pinocchio
