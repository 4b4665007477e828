// The window's small parts that need no display: settings, history, projection, watched files.
#include "app/window/model/actions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "app/window/camera/projection.h"
#include "app/window/model/history.h"
#include "app/window/scene/file_watch.h"
#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

const Rule* press(char key, ViewSettings& settings) {
  return std::get<Change>(binding_of({key, key, true, false, {}})->does)(settings);
}

TEST(ViewSettings, ReprojectionNeedsDesign1) {
  ViewSettings settings;
  settings.settings.exchange = Exchange::reproject;
  const Rule* const rule = press('G', settings);
  ASSERT_TRUE(rule);  // and says why
  EXPECT_NE(rule->what.find("reproject"), std::string_view::npos);
  EXPECT_EQ(preset_of("design", settings), "1");
  settings.settings.exchange = Exchange::pipelined;
  EXPECT_FALSE(press('G', settings));
  EXPECT_EQ(preset_of("design", settings), "2");
  std::set<Exchange> seen;
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(press('X', settings));
    EXPECT_FALSE(broken_rule(wanted_settings(settings)));
    seen.insert(wanted_settings(settings).exchange);
  }
  EXPECT_EQ(seen, (std::set{Exchange::sync, Exchange::pipelined}));
}

TEST(ViewSettings, ExchangeIsPipelinedUnlessGivenAndThatIsNotGiven) {
  ViewSettings settings;
  EXPECT_EQ(wanted_settings(settings).exchange.value, Exchange::pipelined);
  EXPECT_FALSE(wanted_settings(settings).exchange.given);
  settings.settings.exchange = Exchange::sync;
  EXPECT_EQ(wanted_settings(settings).exchange.value, Exchange::sync);
}

// What a preset set is not left behind, and what was given before is there again.
TEST(ViewSettings, PresetsCanBeLeft) {
  ViewSettings settings;
  settings.settings.depth = 3;
  choose_preset("design", "2", settings);
  const Settings before = wanted_settings(settings);
  for (const char* mode : {"raytrace", "raster", "auto", "hybrid"}) {
    (void)press('M', settings);
    EXPECT_EQ(preset_of("mode", settings), mode);
  }
  EXPECT_TRUE(wanted_settings(settings) == before);
  (void)press('L', settings);
  EXPECT_EQ(wanted_settings(settings).reflection.value, ReflectionFormat::rgb8);
  (void)press('L', settings);
  EXPECT_TRUE(wanted_settings(settings) == before);
  (void)press('G', settings);
  EXPECT_FALSE(settings.settings.visibility.given || settings.settings.composite.given);
}

// A command line's presets are the window's, to be left by key.
TEST(ViewSettings, PresetsThatAreGivenAreTakenAsSuch) {
  for (const char* mode : {"raytrace", "raster"}) {
    ViewSettings settings;
    ASSERT_TRUE(apply_preset("mode", mode, settings.settings));
    settings = possible(settings);
    EXPECT_EQ(settings.mode, mode);
    EXPECT_TRUE(settings.shadows && settings.reflections);
    settings.mode = "hybrid";
    EXPECT_TRUE(wanted_settings(settings).traces() && wanted_settings(settings).uses_gpu());
  }
  for (const char* design : {"1", "2"}) {
    ViewSettings settings;
    ASSERT_TRUE(apply_preset("design", design, settings.settings));
    ASSERT_TRUE(apply_preset("plan", "slides", settings.settings));
    const Settings given = settings.settings;
    settings = possible(settings);
    EXPECT_EQ(settings.plan, "slides");
    EXPECT_EQ(preset_of("design", settings), design);
    EXPECT_TRUE(wanted_settings(settings) == given || !given.exchange.given);
  }
  ViewSettings off;
  off.settings.mask_bits = 0;
  off.settings.reflection = ReflectionFormat::none;
  off = possible(off);
  EXPECT_FALSE(off.shadows || off.reflections);
  off.shadows = off.reflections = true;
  EXPECT_FALSE(wanted_settings(off).mask_bits.given || wanted_settings(off).reflection.given);
}

TEST(ViewSettings, StepsKeepToTheirLimits) {
  ViewSettings settings;
  for (int i = 0; i < 200; ++i)
    for (const char key : {',', '[', '-'}) {
      (void)press(key, settings);
      settings = possible(settings);
    }
  EXPECT_EQ(settings.settings.depth, 0);
  EXPECT_EQ(settings.scale, kLeastScale);
  EXPECT_EQ(settings.exposure_ev, -kMostExposure);
}

TEST(ViewSettings, FewerAndMorePixelsMeetWholeSize) {
  ViewSettings settings;
  for (int i = 0; i < 4; ++i) (void)press('[', settings);
  for (int i = 0; i < 4; ++i) (void)press(']', settings);
  EXPECT_EQ(settings.scale, 1.0f);
}

TEST(ViewSettings, EveryBufferComesAndEachMaskSlot) {
  ViewSettings settings;
  std::set<std::pair<Layer, int>> seen;
  for (std::size_t i = 0; i < kShownLayers + 2; ++i) {
    seen.insert({settings.buffer, settings.mask_slot});
    next_buffer(settings, 3);
  }
  EXPECT_EQ(seen.size(), kShownLayers + 2);
  EXPECT_EQ(settings.buffer, Layer::picture);
}

TEST(ViewSettings, ShadowsAndReflectionsAreSwitches) {
  ViewSettings settings;
  settings.shadows = settings.reflections = false;
  EXPECT_FALSE(wanted_settings(settings).traces());
  settings.mode = "raytrace";
  EXPECT_EQ(wanted_settings(settings).mask_bits, 0);
  EXPECT_FALSE(wanted_settings(settings).reflects());
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
  const auto has_changed = [&] { return watch.changed(now += 1.0); };
  EXPECT_FALSE(has_changed());
  std::ofstream(folder / "below/a.frag") << "aa";
  EXPECT_FALSE(has_changed());  // perhaps still being written
  std::ofstream(folder / "below/a.frag") << "aaa";
  EXPECT_FALSE(has_changed());
  EXPECT_TRUE(has_changed());
  EXPECT_FALSE(has_changed());
  std::filesystem::remove(folder / "below/a.frag");
  EXPECT_FALSE(has_changed());
  EXPECT_TRUE(has_changed());
  EXPECT_FALSE(watch.changed(now + 0.01));
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(has_changed());
}

TEST(FileWatch, AFileThatIsWrittenAllTheTimeHoldsUpNoOther) {
  const std::filesystem::path folder = own_folder() / "busy";
  std::filesystem::create_directories(folder);
  FileWatch watch(folder);
  std::string log = "x";
  double now = 1.0;
  const auto has_changed = [&] {
    std::ofstream(folder / "log.txt") << (log += "x");
    return watch.changed(now += 1.0);
  };
  EXPECT_FALSE(has_changed());
  std::ofstream(folder / "scene.gltf") << "a";
  EXPECT_FALSE(has_changed());
  EXPECT_TRUE(has_changed());
  EXPECT_FALSE(has_changed());
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
