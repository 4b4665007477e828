// The window's small parts that need no display: settings, history, projection, watched files.
#include "app/window/settings.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "app/window/file_watch.h"
#include "app/window/history.h"
#include "app/window/projection.h"
#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

TEST(ViewSettings, ReprojectionNeedsDesign1) {
  ViewSettings settings;
  settings.exchange = Exchange::reproject;
  EXPECT_EQ(possible(settings).exchange, Exchange::reproject);
  settings.design = 2;
  EXPECT_EQ(possible(settings).exchange, Exchange::pipelined);
  for (int i = 0; i < 6; ++i) {
    change_setting(Action::next_exchange, settings);
    EXPECT_EQ(possible(settings).exchange, settings.exchange);
  }
}

TEST(ViewSettings, StepsKeepToTheirLimits) {
  ViewSettings settings;
  for (int i = 0; i < 200; ++i)
    for (const Action action : {Action::shallower, Action::coarser, Action::darker}) {
      change_setting(action, settings);
      settings = possible(settings);
    }
  EXPECT_EQ(settings.depth, 0);
  EXPECT_EQ(settings.scale, kLeastScale);
  EXPECT_EQ(settings.exposure_ev, -kMostExposure);
}

TEST(ViewSettings, FewerAndMorePixelsMeetWholeSize) {
  ViewSettings settings;
  for (int i = 0; i < 4; ++i) change_setting(Action::coarser, settings);
  for (int i = 0; i < 4; ++i) change_setting(Action::finer, settings);
  EXPECT_EQ(settings.scale, 1.0f);
}

TEST(ViewSettings, EveryBufferComesAndEachMaskSlot) {
  ViewSettings settings;
  std::set<std::pair<BufferView, int>> seen;
  for (int i = 0; i < 8; ++i) {
    seen.insert({settings.buffer, settings.mask_slot});
    next_buffer(settings, 3);
  }
  EXPECT_EQ(seen.size(), kBufferViewNames.size() + 2);
  EXPECT_EQ(settings.buffer, BufferView::picture);
}

TEST(ViewSettings, ReflectionsOffIsDepthZeroAndTheMaskIsKeptWhereItIsLookedAt) {
  ViewSettings settings;
  settings.reflections = false;
  settings.buffer = BufferView::mask;
  EXPECT_EQ(plan_request(settings).depth, 0);
  EXPECT_TRUE(plan_request(settings).keeps_mask);
}

TEST(History, TimesAreFromEndToEndAndOldFramesAreDropped) {
  History history;
  for (std::size_t i = 0; i < History::kMost + 10; ++i) {
    FrameRecord record;
    record.number = i;
    record[Stage::composite] = {1.0, 1.001};
    record.frame = {0.01 * static_cast<double>(i), 0.01 * static_cast<double>(i) + 0.03};
    record[Stage::raster] = {0.0, 0.002};
    history.add(record);
  }
  history.add(FrameRecord{});  // shown once more
  EXPECT_EQ(history.records().size(), History::kMost);
  EXPECT_NEAR(median_of_newest(history.frame_ms(), 20), 10.0f, 1e-2f);
  EXPECT_NEAR(median_of_newest(history.latency_ms(), 20), 30.0f, 1e-2f);
  EXPECT_NEAR(median_of_newest(history.stage_ms(Stage::raster), 20), 2.0f, 1e-3f);
  EXPECT_EQ(median_of_newest({}, 20), 0.0f);
}

TEST(Projection, ADraggedPointFollowsThePointer) {
  const Camera camera{"", {3, 4, 5}, {0, 0, 0}, {0, 1, 0}, 50.0f};
  const glm::vec2 screen(640.0f, 480.0f), moved(35.0f, -20.0f);
  const auto center = project(camera, screen, camera.target);
  ASSERT_TRUE(center);
  EXPECT_LT(glm::length(center->position - 0.5f * screen), 1e-2f);
  const glm::vec3 p(0.5f, -0.3f, 0.8f);
  const auto before = project(camera, screen, p);
  ASSERT_TRUE(before);
  const auto after = project(camera, screen, p + unproject_move(camera, screen, before->z_eye, moved));
  ASSERT_TRUE(after);
  EXPECT_LT(glm::length(after->position - before->position - moved), 1e-2f);
  EXPECT_FALSE(project(camera, screen, {6, 8, 10}));  // behind the camera
}

TEST(FileWatch, AChangeCountsOnceAndWhenItHasSettled) {
  const std::filesystem::path folder = own_folder() / "watched";
  std::filesystem::create_directories(folder / "below");
  std::ofstream(folder / "below/a.frag") << "a";
  FileWatch watch(folder);
  double now = 1.0;
  const auto look = [&] { return watch.changed(now += 1.0); };
  EXPECT_FALSE(look());
  std::ofstream(folder / "below/a.frag") << "aa";
  EXPECT_FALSE(look());  // perhaps still being written
  std::ofstream(folder / "below/a.frag") << "aaa";
  EXPECT_FALSE(look());
  EXPECT_TRUE(look());
  EXPECT_FALSE(look());
  std::filesystem::remove(folder / "below/a.frag");
  EXPECT_FALSE(look());
  EXPECT_TRUE(look());
  EXPECT_FALSE(watch.changed(now + 0.01));
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(look());
}

TEST(FileWatch, AFileThatIsWrittenAllTheTimeHoldsUpNoOther) {
  const std::filesystem::path folder = own_folder() / "busy";
  std::filesystem::create_directories(folder);
  FileWatch watch(folder);
  std::string log = "x";
  double now = 1.0;
  const auto look = [&] {
    std::ofstream(folder / "log.txt") << (log += "x");
    return watch.changed(now += 1.0);
  };
  EXPECT_FALSE(look());
  std::ofstream(folder / "scene.gltf") << "a";
  EXPECT_FALSE(look());
  EXPECT_TRUE(look());
  EXPECT_FALSE(look());
  std::filesystem::remove_all(folder);
}

TEST(FileWatch, LooksAtTheFilesItFollowsAlone) {
  const std::filesystem::path folder = own_folder() / "followed";
  std::filesystem::create_directories(folder);
  const std::string scene = (folder / "scene.gltf").string(), texture = (folder / "texture.png").string(),
                    other = (folder / "other.png").string();
  std::ofstream(scene) << "a";
  FileWatch watch(std::vector{scene, texture});
  double now = 1.0;
  const auto changes = [&] {
    const bool at_once = watch.changed(now += 1.0);
    return watch.changed(now += 1.0) || at_once;
  };
  std::ofstream(folder / "screenshot-001.png") << "beside it";
  EXPECT_FALSE(changes());
  std::ofstream(texture) << "was missing";
  EXPECT_TRUE(changes());
  std::ofstream(other) << "a";
  std::ofstream(scene) << "names other.png now";
  watch.follow({scene, other});
  EXPECT_TRUE(changes());  // the scene's change came before follow(), and counts
  std::ofstream(texture) << "of no more use";
  EXPECT_FALSE(changes());
  std::ofstream(other) << "changed";
  EXPECT_TRUE(changes());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pinocchio::app
