// What a person takes along: the command line, the camera's file, names that are not taken yet.
#include "app/window/export.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

struct Taken {
  DrawOptions options;
  ViewSettings settings;
  Camera camera{"", {1.5f, 0.1f, -2.0f}, {0, 1, 0}, {0, 1, 0}, 40.0f};
  std::vector<Light> lights;

  [[nodiscard]] std::string command(const std::string& scene = "boat.glb", int samples = 1) const {
    return render_command({scene, options, settings, camera, lights, {640, 480}, samples}, "boat-001");
  }
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Takeaway, DefaultsAreLeftOutAndNumbersAreExact) {
  EXPECT_EQ(
      Taken().command(),
      "pinocchio render boat.glb --size 640x480 --eye 1.5,0.1,-2 --target 0,1,0 --fov 40 -o boat-001.exr "
      "--preview boat-001.png");
  Taken taken;
  taken.camera.eye.x = 1.0f / 3.0f;
  const std::string command = taken.command();
  const std::size_t at = command.find("--eye ") + 6;
  EXPECT_EQ(std::stof(command.substr(at)), taken.camera.eye.x);
}

TEST(Takeaway, WhatWasChangedIsSaid) {
  Taken taken;
  taken.settings.mode = Mode::raytrace;
  taken.settings.design = 2;
  taken.settings.plan = PlanSource::slides;
  taken.settings.reflections = false;
  taken.settings.exposure_ev = -1.5f;
  taken.camera.up = {0, 0, 1};
  Light light;
  light.position = {1, 2, 3};
  light.casts_shadow = false;
  taken.lights = {light};
  const std::string command = taken.command("boat.glb", 16);
  for (const char* part : {"--mode raytrace", "--design 2", "--plan slides", "--depth 0", "--exposure -1.5",
                           "--up 0,0,1", "--light 1,2,3,1,nocast", "--spp 16"})
    EXPECT_TRUE(holds(command, part)) << part << " in " << command;
}

TEST(Takeaway, NamesAreQuotedForAShell) {
  EXPECT_TRUE(holds(Taken().command("my boat's.glb"), "render 'my boat'\\''s.glb' "));
}

TEST(Takeaway, APlanFileSaysModeDesignAndDepth) {
  Taken taken;
  taken.settings.plan = PlanSource::file;
  taken.settings.mode = Mode::raster;
  taken.options.plan_file = "plan.json";
  EXPECT_TRUE(holds(taken.command(), "--plan plan.json"));
  EXPECT_FALSE(holds(taken.command(), "--mode"));
}

TEST(Takeaway, TheCameraIsAPathOfOneKeyFrame) {
  const nlohmann::json json = nlohmann::json::parse(camera_path_json(Taken().camera));
  ASSERT_EQ(json.at("keyframes").size(), 1u);
  EXPECT_EQ(json["keyframes"][0]["eye"][0].get<float>(), 1.5f);
  EXPECT_EQ(json["keyframes"][0]["fov"].get<float>(), 40.0f);
}

TEST(Takeaway, NamesThatAreTakenAreSkipped) {
  const std::string stem = own_file("shot").string();
  EXPECT_EQ(unused_name(stem, {".png", ".exr"}), stem + "-001");
  std::ofstream(stem + "-001.exr") << "x";
  EXPECT_EQ(unused_name(stem, {".png", ".exr"}), stem + "-002");
}

}  // namespace
}  // namespace pinocchio::app
