// The window's parts that need no display: messages, what is remembered, undo, what F shows, folders.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/window/camera/framing.h"
#include "app/window/model/history.h"
#include "app/window/model/messages.h"
#include "app/window/model/model.h"
#include "app/window/model/preferences.h"
#include "app/window/model/scene_files.h"
#include "app/window/scene/edit_history.h"
#include "app/window/screen/pace.h"
#include "core/base/clock.h"
#include "pinocchio/load.h"
#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

TEST(Messages, NewsGoByThemselvesAndErrorsStayUntilMended) {
  Messages messages;
  messages.hint("news", 1.0);
  messages.error("scene", "first");
  messages.error("scene", "second");
  messages.warning("warning");
  EXPECT_EQ(messages.all().size(), 3u);
  EXPECT_TRUE(messages.expire(now_s() + 2.0));
  EXPECT_FALSE(messages.expire(now_s() + 2.0));
  EXPECT_EQ(messages.all().front().text, "second");
  messages.clear("scene");
  ASSERT_EQ(messages.all().size(), 1u);
  messages.dismiss(0);
  EXPECT_TRUE(messages.all().empty());
}

TEST(Messages, AHintReplacesTheOneAboutTheSame) {
  Messages messages;
  messages.hint("measuring 1 of 9", 1.0, "budget");
  messages.hint("other");
  messages.hint("measuring 2 of 9", 1.0, "budget");
  ASSERT_EQ(messages.all().size(), 2u);
  EXPECT_EQ(messages.all().back().text, "measuring 2 of 9");
  for (int i = 0; i < 3; ++i) messages.warning("warning " + std::to_string(i));
  messages.clear_warnings();
  EXPECT_EQ(messages.all().size(), 2u);
}

TEST(Preferences, AreReadAsTheyWereWritten) {
  const std::filesystem::path file = own_folder() / "config/pinocchio/window.json";
  std::filesystem::remove_all(own_folder() / "config");
  Preferences written;
  written.panels[Panel::timeline] = true;
  written.panels[Panel::help] = true;  // is asked for each time
  written.layout = "[Window][Timeline]\nPos=1,2\n";
  for (int i = 0; i < 20; ++i) written.add_recent("/scenes/" + std::to_string(i) + ".obj");
  written.add_recent("/scenes/15.obj");
  save_preferences(written, file);
  const Preferences read = load_preferences(file);
  EXPECT_TRUE(read.panels[Panel::timeline]);
  EXPECT_FALSE(read.panels[Panel::help]);
  EXPECT_EQ(read.layout, written.layout);
  ASSERT_EQ(read.recent.size(), 12u);
  EXPECT_EQ(read.recent[0], "/scenes/15.obj");
  EXPECT_EQ(read.recent[1], "/scenes/19.obj");
  for (const char* damaged : {"", "{", "[]", "{\"open\": 3, \"layout\": [], \"recent\": {\"a\": 1}}"}) {
    std::ofstream(file) << damaged;
    EXPECT_TRUE(load_preferences(file).recent.empty()) << damaged;
  }
}

TEST(EditHistory, ChangesThatFollowEachOtherAreOneStep) {
  EditHistory edits;
  EditState state;
  edits.begin(state);
  EXPECT_FALSE(edits.undo());
  for (int i = 1; i <= 5; ++i) {
    state.camera.eye.x = static_cast<float>(i);
    edits.note(state, 10.0 + 0.1 * i);
  }
  state.settings.shadows = false;
  edits.note(state, 20.0);
  EXPECT_TRUE(edits.undo()->settings.shadows);
  EXPECT_EQ(edits.undo()->camera.eye.x, EditState().camera.eye.x);
  EXPECT_FALSE(edits.undo());
  EXPECT_EQ(edits.redo()->camera.eye.x, 5.0f);
  EXPECT_FALSE(edits.redo()->settings.shadows);
  EXPECT_FALSE(edits.redo());
}

TEST(History, TimeInWhichNothingIsDrawnIsCutOut) {
  History history;
  double now = 100.0;
  const auto draw = [&] {
    FrameRecord record;
    record[Stage::composite] = {now, now + 0.01};
    record.frame = {now, now + 0.01};
    history.add(record);
    now += 0.01;
  };
  for (int i = 0; i < 10; ++i) draw();
  history.pause();
  now += 60.0;
  for (int i = 0; i < 10; ++i) draw();
  EXPECT_NEAR(history.rate(), 100.0, 1.0);
  for (const float ms : history.frame_ms()) EXPECT_NEAR(ms, 10.0f, 0.1f);
  const FrameRecord &first = history.records().front(), &last = history.records().back();
  EXPECT_NEAR(last.frame.end_s - first.frame.begin_s, 0.2, 1e-3);
  EXPECT_NEAR(last[Stage::composite].end_s - last.frame.begin_s, 0.01, 1e-6);
}

// A room with something in it: not the room's walls from outside.
TEST(Framing, WhatMattersOfARoomIsInIt) {
  const Scene scene = load_scene(PINOCCHIO_SOURCE_DIR "/scenes/two-lights").value();
  const Bounds all = scene.mesh->bounds(), interest = bounds_of_interest(*scene.mesh);
  EXPECT_FALSE(interest.empty());
  EXPECT_LT(interest.diagonal(), 0.7f * all.diagonal());
  const Tracer tracer(scene.mesh);
  Camera camera;
  camera.target = interest.center();
  camera.eye = camera.target + glm::vec3(0.0f, 0.0f, 10.0f * all.diagonal());
  camera = before_walls(camera, interest, tracer);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(camera.eye[axis], all.lo[axis]);
    EXPECT_LT(camera.eye[axis], all.hi[axis]);
  }
  // A box alone matters itself.
  MeshData data;
  data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  data.normals.resize(3);
  data.triangles = {{0, 1, 2}};
  data.triangle_materials = {0};
  data.materials.resize(1);
  EXPECT_EQ(bounds_of_interest(Mesh(data)).diagonal(), Mesh(data).bounds().diagonal());
}

// Of lit and shadowed pixels, and of those in the mirror: what lights, ambience and mirrors bring is its
// colour.
TEST(PixelInspector, WhatLightsAndMirrorsBringIsTheColour) {
  const Scene scene = load_scene(PINOCCHIO_SOURCE_DIR "/scenes/two-lights").value();
  Model model;
  model.scene = scene;
  model.camera.set_camera(scene.cameras.front());
  model.window_pixels = {160, 120};
  model.settings.settings.depth = 8;
  PixelInspector inspector;
  EXPECT_FALSE(inspector.report(model, {80, 60}));
  EXPECT_TRUE(model.wants_tree);
  model.tracer = std::make_shared<const Tracer>(scene.mesh);
  bool mirrors = false, shadow = false;
  for (int i = 0; i < 48; ++i) {
    const glm::ivec2 pixel(10 + 20 * (i % 8), 10 + 20 * (i / 8));
    const PixelReport report = inspector.report(model, pixel).value();
    if (report.triangle == kNoTriangle) continue;
    EXPECT_LT(report.material, scene.mesh->materials.size());
    EXPECT_GT(report.depth, 0.0f);
    EXPECT_NEAR(glm::length(report.normal), 1.0f, 1e-5f);
    ASSERT_EQ(report.lights.size(), scene.lights.size());
    glm::vec3 sum = report.ambient + report.mirrored;
    for (const PixelReport::LightShare& light : report.lights) {
      sum += light.light;
      EXPECT_EQ(light.reaches, light.light != glm::vec3(0.0f));
      shadow = shadow || !light.reaches;
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], report.color[c], 1e-5f) << pixel.x << " " << pixel.y;
    EXPECT_EQ(report.bounces > 0, report.rays.reflection + report.rays.refraction > 0);
    mirrors = mirrors || report.bounces > 0;
  }
  EXPECT_TRUE(mirrors);
  EXPECT_TRUE(shadow);
}

TEST(SceneFiles, AFolderIsSteppedThroughAndAround) {
  const std::filesystem::path folder = own_folder() / "scenes";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "more");
  for (const char* name : {"b.GLB", "a.obj", "c.ply", "bb.hdr", "notes.txt", ".hidden.obj"})
    std::ofstream(folder / name) << "x";
  const std::vector<FolderEntry> entries = scenes_in(folder);
  ASSERT_EQ(entries.size(), 5u);  // arrows step over the environment
  EXPECT_TRUE(entries[0].is_folder);
  EXPECT_EQ(neighbour_of(folder / "a.obj", 1), (folder / "b.GLB").string());
  EXPECT_EQ(neighbour_of(folder / "a.obj", -1), (folder / "c.ply").string());
  EXPECT_EQ(neighbour_of(folder / "c.ply", 1), (folder / "a.obj").string());
  EXPECT_TRUE(scenes_in(folder / "missing").empty());
}

TEST(Pace, CountsFromTheLastPoll) {
  Pace pace;
  pace.polled(0.0, 1.0, false);
  pace.polled(1.5, 1.5, true);  // came while it was busy, since 1.0 at worst
  pace.redrawn(1.6, true);
  pace.polled(1.6, 2.0, true);  // came while it waited
  pace.polled(2.0, 2.1, true);  // and another before the answer
  pace.redrawn(2.1, true);
  pace.redrawn(2.2, false);
  const nlohmann::json json = pace.json();
  EXPECT_EQ(json["input_to_display"]["count"], 2);
  EXPECT_NEAR(json["input_to_display"]["worst_ms"].get<double>(), 600.0, 1e-6);
  EXPECT_NEAR(json["input_to_display"]["median_ms"].get<double>(), 600.0, 1e-6);
  EXPECT_EQ(json["between_redraws_while_loading"]["count"], 1);
  EXPECT_NEAR(json["between_redraws_while_loading"]["redraws_per_s"].get<double>(), 2.0, 1e-6);
}

}  // namespace
}  // namespace pinocchio::app
