// What leaves the window: the command line, the camera's file, names that are not taken yet.
#include "app/window/model/export.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/window/model/settings.h"
#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

struct Exported {
  ViewSettings settings;
  Camera camera{"", {1.5f, 0.1f, -2.0f}, {0, 1, 0}, {0, 1, 0}, 40.0f};
  std::vector<Light> lights;

  [[nodiscard]] std::string command(const std::string& scene = "boat.glb", int samples = 1) const {
    ExportedView view;
    view.scene = scene;
    view.settings = wanted_settings(settings);
    view.camera = camera;
    view.extra_lights = lights;
    view.size = {640, 480};
    view.samples = samples;
    view.exposure_ev = settings.exposure_ev;
    view.tone_map = settings.tone_map;
    return render_command(view, "boat-001");
  }
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Export, DefaultsAreLeftOutAndNumbersAreExact) {
  EXPECT_EQ(
      Exported().command(),
      "pinocchio render boat.glb --size 640x480 --eye 1.5,0.1,-2 --target 0,1,0 --fov 40 -o boat-001.exr "
      "--preview boat-001.png");
  Exported view;
  view.camera.eye.x = 1.0f / 3.0f;
  const std::string command = view.command();
  const std::size_t at = command.find("--eye ") + 6;
  EXPECT_EQ(std::stof(command.substr(at)), view.camera.eye.x);
}

TEST(Export, TheTimeOfAnAnimationIsSaid) {
  ExportedView view;
  view.time_s = 0.1;
  EXPECT_TRUE(holds(render_command(view, "mill"), " --time 0.1 "));
}

// `render` would choose its own, otherwise.
TEST(Export, FilterSamplesAndExposureAreSaid) {
  ExportedView view;
  view.studio_light = true;
  EXPECT_TRUE(holds(render_command(view, "mill"), " --spp 1 --exposure 0 "));
  view.denoised = true;
  EXPECT_TRUE(holds(render_command(view, "mill"), " --denoise --spp 1 "));
}

// `render` begins with the file's first camera.
TEST(Export, ProjectionLensAndFocusAreSaidWhereTheFirstCameraHasOthers) {
  ExportedView view;
  view.usual_camera.projection = Projection::fisheye;
  view.usual_camera.lens_radius = 0.25f;
  view.usual_camera.focus_distance = 3.0f;
  view.camera = view.usual_camera;
  const std::string same = render_command(view, "boat");
  for (const char* option : {"--projection", "--lens-radius", "--focus"})
    EXPECT_FALSE(holds(same, option)) << option << " in " << same;
  view.camera = Camera{};
  EXPECT_TRUE(
      holds(render_command(view, "boat"), " --projection perspective --lens-radius 0 --focus 0 -o boat.exr"));
}

TEST(Export, WhatIsReadBesideTheSceneIsSaid) {
  ExportedView view;
  view.environment = "a sky.hdr";
  view.load.limit_bytes = std::uint64_t{8} << 30;
  view.load.confine = true;
  view.load.shading = Shading::phong;
  view.camera.lens_radius = 0.25f;
  view.camera.focus_distance = 3.0f;
  view.load.animation = "walk cycle";
  view.load.variant = "red";
  view.load.point_size = 0.5f;
  view.load.line_width = 0.25f;
  const std::string command = render_command(view, "boat");
  for (const char* part :
       {" --environment 'a sky.hdr' ", " --load-limit 8192 ", " --confine ", " --shading phong ",
        " --lens-radius 0.25 ", " --focus 3 ", " --animation 'walk cycle' ", " --variant red ",
        " --point-size 0.5 ", " --line-width 0.25 "})
    EXPECT_TRUE(holds(command, part)) << part << " in " << command;
}

void expect_said(const std::string& command, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_TRUE(holds(command, part)) << part << " in " << command;
}

TEST(Export, WhatWasChangedIsSaid) {
  Exported view;
  view.settings.mode = "raytrace";
  view.settings.reflections = false;
  view.settings.exposure_ev = -1.5f;
  view.settings.tone_map = ToneMap::aces;
  view.camera.up = {0, 0, 1};
  Light light;
  light.position = {1, 2, 3};
  light.casts_shadow = false;
  view.lights = {light};
  expect_said(view.command("boat.glb", 16),
              {"--mode raytrace", "--reflection none", "--exposure -1.5 --tone-map aces", "--up 0,0,1",
               "--light 1,2,3,1,nocast", "--spp 16"});
}

TEST(Export, PresetsAreSaidByTheirNames) {
  Exported view;
  choose_preset("design", "2", view.settings);
  view.settings.plan = "slides";
  const std::string command = view.command();
  expect_said(command, {" --design 2 --plan slides --eye"});
  view.settings.shadows = false;  // the slides' plan has a mask: field by field, then
  expect_said(view.command(), {"--design 2", "--mask-bits 0", "--reflection rgb8", "--wide", "--no-reuse"});
  EXPECT_FALSE(holds(view.command(), "--plan"));
}

// Whoever set it, the command line or a plan's file; the number of samples is the one that was gathered.
TEST(Export, EveryGivenSettingIsSaid) {
  Exported view;
  Settings& s = view.settings.settings;
  s.depth = 3;
  s.tree_leaf = 4;
  s.tiles = false;
  s.persistent = true;
  s.exchange = Exchange::sync;
  s.spp = 100;
  const std::string command = view.command();
  expect_said(command, {"--depth 3", "--tree-leaf 4", "--no-tiles", "--persistent", "--exchange sync"});
  for (const char* part : {"--spp", "--mode", "--plan", "--design"})
    EXPECT_FALSE(holds(command, part)) << part;
}

// A value of the field that it does not have by itself.
std::string another_value(const Field& field) {
  const Settings usual;
  for (const auto& values : {field.choices, field.examples})
    for (const std::string_view value : values)
      if (value != field.text(usual)) return std::string(value);
  for (const double value : {field.hi, field.lo}) {
    std::string text = std::to_string(value);
    text.resize(text.find('.'));
    if (text != field.text(usual)) return text;
  }
  return {};
}

// The one table of settings: whichever is another than by itself is in the command, by its option or by a
// preset's that says it.
TEST(Export, EverySettingOfTheTableIsSaid) {
  for (const Field& field : settings_table()) {
    Exported view;
    ASSERT_TRUE(field.take(another_value(field), view.settings.settings)) << field.name;
    const std::string value = field.text(view.settings.settings);
    const std::string usual = Exported().command(), command = view.command();
    if (field.name == "spp") continue;  // the samples that were gathered are said instead
    EXPECT_NE(command, usual) << field.name;
    const std::string said =
        field.kind == Field::Kind::flag && value == "false"
            ? " --no-" + field.option().substr(2) + " "
            : " " + field.option() + (field.kind == Field::Kind::flag ? " " : " " + value + " ");
    const bool by_preset = holds(command, "--mode") || holds(command, "--design") || holds(command, "--plan");
    EXPECT_TRUE(holds(command, said) || by_preset) << said << "in " << command;
  }
}

TEST(Export, NamesAreQuotedForAShell) {
  EXPECT_TRUE(holds(Exported().command("my boat's.glb"), "render 'my boat'\\''s.glb' "));
}

TEST(Export, TheCameraIsAPathOfOneKeyFrame) {
  const nlohmann::json json = nlohmann::json::parse(camera_path_json(Exported().camera));
  ASSERT_EQ(json.at("keyframes").size(), 1u);
  EXPECT_EQ(json["keyframes"][0]["eye"][0].get<float>(), 1.5f);
  EXPECT_EQ(json["keyframes"][0]["fov"].get<float>(), 40.0f);
}

TEST(Export, NamesThatAreTakenAreSkipped) {
  const std::string stem = own_file("shot").string();
  EXPECT_EQ(unused_name(stem, {".png", ".exr"}), stem + "-001");
  std::ofstream(stem + "-001.exr") << "x";
  EXPECT_EQ(unused_name(stem, {".png", ".exr"}), stem + "-002");
}

}  // namespace
}  // namespace pinocchio::app
