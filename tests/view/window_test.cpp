// The window, on a display of its own: what it shows, what keys and mouse do, how it ends.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

TEST_F(WindowTest, ScreenshotIsTheDisplaysAndThePrintedCommandDrawsIt) {
  open(scene("cornell"));
  key(kStill);
  drag(1, 40, 20);
  const std::string command = command_line();
  settle("display.png");
  key("F12");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-001.png"); }));
  EXPECT_EQ(different("display.png", "cornell-001.png"), 0);
  expect_clean_close();

  // The same picture, headless.
  const std::string program = "'" PINOCCHIO_PROGRAM "'";
  std::string headless = command;
  headless.replace(0, std::string("pinocchio").size(), program);
  headless.replace(headless.find("-o cornell-001.exr"), 18, "-o headless.exr");
  headless.replace(headless.find("--preview cornell-001.png"), 25, "--preview headless.png");
  const std::string there = "cd '" + folder_.string() + "' && ";
  EXPECT_EQ(run_command(there + headless, folder_).exit_code, 0) << headless;
  const CommandResult compared =
      run_command(there + program + " compare headless.exr cornell-001.exr --max-error max=0", folder_);
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err;
  EXPECT_EQ(different("headless.png", "display.png"), 0);
}

TEST_F(WindowTest, MouseAndKeysMoveTheCamera) {
  open(scene("cornell"));
  key(kStill);
  const std::string first = command_line();
  const std::string eye = option(first, "--eye"), target = option(first, "--target");
  ASSERT_FALSE(eye.empty());
  const auto moved = [&](bool eye_moves, bool target_moves, const char* what) {
    const std::string now = command_line();
    EXPECT_EQ(option(now, "--eye") != eye, eye_moves) << what;
    EXPECT_EQ(option(now, "--target") != target, target_moves) << what;
    key("r");
  };
  drag(1, 60, 30);
  moved(true, false, "orbit");
  drag(1, 60, 30, "shift");
  moved(true, true, "pan by Shift");
  drag(2, 60, 30);
  moved(true, true, "pan");
  drag(3, 0, 40);
  moved(true, false, "zoom");
  xdo("mousemove --window " + window_ + " 160 120 click 4 click 4");
  moved(true, false, "wheel");
  key("w d e");
  moved(true, true, "flight");
  key("f");
  moved(true, true, "whole scene");
  moved(false, false, "reset");
  key("w 1");
  moved(false, false, "the first camera");
  EXPECT_EQ(command_line(), first);
  expect_clean_close();
}

TEST_F(WindowTest, KeysChangeWhatIsDrawn) {
  open(scene("cornell"));
  key(kStill);
  key("m");
  EXPECT_EQ(option(command_line(), "--mode"), "raytrace");
  key("m");
  EXPECT_EQ(option(command_line(), "--mode"), "raster");
  key("m");
  EXPECT_EQ(option(command_line(), "--mode"), "auto");
  key("m");
  EXPECT_EQ(option(command_line(), "--mode"), "");
  key("g");
  EXPECT_EQ(option(command_line(), "--design"), "2");
  key("g l");
  EXPECT_EQ(option(command_line(), "--plan"), "slides");
  key("l i");
  EXPECT_EQ(option(command_line(), "--reflection"), "none");
  key("i comma comma");
  EXPECT_EQ(option(command_line(), "--depth"), "6");
  key("plus");
  EXPECT_EQ(option(command_line(), "--exposure"), "0.5");
  const std::string size = option(command_line(), "--size");
  key("bracketleft");
  EXPECT_NE(option(command_line(), "--size"), size);
  key("bracketright");
  EXPECT_EQ(option(command_line(), "--size"), size);
  key("o");
  EXPECT_EQ(option(command_line(), "--mask-bits"), "0");
  key("c");
  EXPECT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-001-camera.json"); }));
  expect_clean_close();
}

TEST_F(WindowTest, AStillCameraGathersSamplesAndMovingDropsBack) {
  open(scene("cornell"), "--exchange sync");
  std::string samples;
  EXPECT_TRUE(becomes([&] {
    samples = option(command_line(), "--spp");
    return !samples.empty() && std::stoi(samples) >= 4;
  })) << samples;
  key("w");
  key(kStill);  // what was gathered is dropped
  EXPECT_EQ(option(command_line(), "--spp"), "");
  expect_clean_close();
}

TEST_F(WindowTest, GatheringStopsAtTheSamplesThatWereAskedFor) {
  open(scene("cornell"), "--spp 3");
  const auto samples = [this] { return option(command_line(), "--spp"); };
  EXPECT_TRUE(becomes([&] { return samples() == "3"; }));
  pause_ms(1000);
  EXPECT_EQ(samples(), "3");
  expect_clean_close();
}

// Its mark is in the middle of the window, where the camera looks.
TEST_F(WindowTest, ADraggedLightIsInAFileThatTheCommandDraws) {
  open(scene("cornell"), "--eye 0,1,3.4 --target 0,1,0 --light 0,1,0,0.5 --mode raster");
  EXPECT_NE(command_line().find("--light 0,1,0,0.5,cast"), std::string::npos);
  key("h F5");
  xdo("windowsize --sync " + window_ + " 700 500");
  pause_ms(500);
  const std::string to = "mousemove --window " + window_ + " ";
  xdo(to + "350 250 sleep 0.5 mousedown 1 sleep 0.4 " + to + "356 253 sleep 0.4 " + to +
      "362 256 sleep 0.4 mouseup 1");
  const std::string command = command_line();
  EXPECT_NE(command.find("render cornell-001.gltf"), std::string::npos) << command;
  EXPECT_EQ(command.find("--light"), std::string::npos) << command;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cornell-001.gltf"));
  expect_clean_close();
}

// A file with the studio's lamp in it would have a light, so it would be drawn without the studio.
TEST_F(WindowTest, TheStudioIsNotSavedWithTheScene) {
  std::ofstream(folder_ / "corner.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  open((folder_ / "corner.obj").string());
  key("ctrl+s");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "corner-001.gltf"); }));
  EXPECT_EQ(text_of(folder_ / "corner-001.gltf").find("KHR_lights_punctual"), std::string::npos);
  const std::string command = command_line();
  ASSERT_FALSE(command.empty());
  EXPECT_EQ(command.find("--environment"), std::string::npos) << command;
  expect_clean_close("a studio lights and frames it");
}

// OpenGL cannot draw a panorama, so the first picture waits for the tree.
TEST_F(WindowTest, APanoramaIsDrawnFromTheStartOn) {
  open(scene("cornell"), "--projection panorama");
  EXPECT_TRUE(becomes([this] {
    settle("panorama.png");
    const Image<glm::u8vec3> seen = picture("panorama.png");
    return std::ranges::count_if(seen.pixels(), [](const glm::u8vec3& p) { return p.g > 20; }) > 20000;
  }));
  expect_clean_close();
}

// As on a full disk: the window stays, and says what happened.
TEST_F(WindowTest, ARecordingThatCannotBeWrittenEnds) {
  open(scene("cornell"), "--mode raster");
  key(kStill);
  std::filesystem::create_directories(folder_ / "cornell-001-0002.png" / "taken");
  key("k");
  ASSERT_TRUE(becomes([this] {
    drag(1, 10, 5);
    return errors().find("the recording has ended") != std::string::npos;
  })) << errors();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cornell-001-0001.png"));
  EXPECT_TRUE(program_->running());
  expect_clean_close("cornell-001-0002.png");
}

TEST_F(WindowTest, EveryKey) {
  open(scene("cornell"), "--plan slides");
  std::string keys = "Tab Return BackSpace Insert Home End Prior Next Left Right Up Down space";
  for (char c = 'a'; c <= 'z'; ++c) keys += std::string(" ") + c;
  for (char c = '0'; c <= '9'; ++c) keys += std::string(" ") + c;
  for (int i = 1; i <= 12; ++i) keys += " F" + std::to_string(i);
  keys += " comma period slash semicolon apostrophe bracketleft bracketright backslash minus equal grave";
  keys += " KP_Add KP_Subtract KP_1 KP_Enter shift+w ctrl+a alt+b F11";
  key(keys);
  key("v v v v v v v x x x b b b");
  EXPECT_TRUE(program_->running()) << errors();
  EXPECT_FALSE(command_line().empty()) << errors();
  EXPECT_TRUE(becomes([this] {  // what is open is closed first
    key("Escape");
    return program_->wait(0.5) != -2;
  }));
  EXPECT_EQ(program_->wait(), 0) << errors();
  EXPECT_EQ(errors(), "");
}

TEST_F(WindowTest, ResizedAHundredTimesAndMinimised) {
  open(scene("cornell"));
  const auto resize = [this](int from, int to) {
    std::string all;
    for (int i = from; i < to; ++i)
      all += " windowsize " + window_ + " " + std::to_string(100 + 37 * (i % 7)) + " " +
             std::to_string(90 + 23 * (i % 9)) + " sleep 0.02";
    xdo(all);
    ASSERT_TRUE(program_->running()) << errors();
  };
  resize(0, 20);
  pause_ms(500);
  const double before_mb = program_->memory_mb();
  resize(20, 120);
  xdo("windowminimize " + window_ + " sleep 0.4 windowactivate --sync " + window_ + " mousemove --window " +
      window_ + " 40 40 click 1 windowfocus --sync " + window_);
  pause_ms(500);
  EXPECT_LT(program_->memory_mb(), before_mb + 60.0);
  xdo("windowsize --sync " + window_ + " 320 240");
  EXPECT_TRUE(becomes([this] { return option(command_line(), "--size") == "320x240"; }));
  expect_clean_close();
}

TEST_F(WindowTest, MemoryStaysWhileItIsUsed) {
  open(scene("cornell"));
  const auto use = [this] {
    for (int i = 0; i < 4; ++i) drag(1, 60, i % 2 ? 20 : -20);
    key("v v v x m m m g g o o b b b h h");
  };
  use();
  use();
  const double before_mb = program_->memory_mb();
  for (int i = 0; i < 4; ++i) use();
  EXPECT_LT(program_->memory_mb(), before_mb + 40.0);
  expect_clean_close();
}

TEST_F(WindowTest, WatchedShadersAndScene) {
  std::filesystem::copy(PINOCCHIO_SOURCE_DIR "/shaders", folder_ / "shaders",
                        std::filesystem::copy_options::recursive);
  for (const char* file : {"cornell.gltf", "cornell.bin"}) std::filesystem::copy(scene(file), folder_ / file);
  open("cornell.gltf", "--watch", {"PINOCCHIO_SHADERS=" + (folder_ / "shaders").string()});
  key(kStill);
  settle("sound.png");
  const std::string sound = text_of(folder_ / "shaders/composite.frag");
  std::ofstream(folder_ / "shaders/composite.frag") << sound << "no shader\n";
  const auto differs = [this](const std::string& from) {
    grab("now.png");
    return different(from, "now.png") > 100;
  };
  EXPECT_TRUE(becomes([&] { return differs("sound.png"); }));  // the error, over the last good picture
  settle();
  drag(1, 30, 0);  // the last good shaders still draw
  key("r");
  std::ofstream(folder_ / "shaders/composite.frag") << sound;
  EXPECT_TRUE(becomes([&] { return !differs("sound.png"); }));
  // The scene, darker.
  std::string gltf = text_of(folder_ / "cornell.gltf");
  const std::size_t at = gltf.find("\"intensity\"");
  ASSERT_NE(at, std::string::npos);
  gltf.replace(at, gltf.find_first_of(",}\n", at) - at, "\"intensity\": 0.001");
  std::ofstream(folder_ / "cornell.gltf") << gltf;
  EXPECT_TRUE(becomes([&] { return differs("sound.png"); }));
  expect_clean_close("the last good shaders stay in use");
}

TEST_F(WindowTest, ASignalEndsIt) {
  open(scene("two-lights"));
  drag(1, 20, 10);
  program_->signal(SIGTERM);
  EXPECT_EQ(program_->wait(), 130);
  EXPECT_EQ(errors(), "");
}

TEST_F(WindowTest, TheDisplayGoesAwayInMidFrame) {
  open(scene("two-lights"));
  server_->signal(SIGKILL);
  EXPECT_EQ(program_->wait(), 1);
  EXPECT_NE(errors().find("the display is gone"), std::string::npos) << errors();
}

TEST_F(WindowTest, AClosedWindowDoesNotWaitForAScene) {
  ASSERT_EQ(run_command("cd '" + folder_.string() +
                            "' && '" PINOCCHIO_PROGRAM "' generate spd:balls --triangles 300000 -o balls.glb",
                        folder_)
                .exit_code,
            0);
  program_.emplace(std::vector<std::string>{PINOCCHIO_PROGRAM, "view", "balls.glb", "--size", "320x240"},
                   folder_, std::vector<std::string>{"DISPLAY=" + display_}, folder_ / "out.txt",
                   folder_ / "err.txt");
  ASSERT_TRUE(becomes([this] { return !xdo("search --onlyvisible --name Pinocchio").empty(); }));
  window_ = xdo("search --onlyvisible --name Pinocchio");
  window_ = window_.substr(0, window_.find('\n'));
  expect_clean_close();
}

TEST(View, WithoutADisplayItEndsWithThreeAndPointsToRender) {
  const CommandResult result = run_command("env -u DISPLAY -u WAYLAND_DISPLAY '" PINOCCHIO_PROGRAM
                                           "' view '" PINOCCHIO_SOURCE_DIR "/scenes/cornell'",
                                           own_folder());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("pinocchio render"), std::string::npos) << result.err;
}

TEST(View, OptionsOfAPictureWithoutAWindowAreUnknown) {
  const std::string view = "'" PINOCCHIO_PROGRAM "' view '" PINOCCHIO_SOURCE_DIR "/scenes/cornell' ";
  for (const char* option :
       {"--backend egl", "--device 0", "--crop 0,0,9,9", "--precise", "--gl-threads 1"}) {
    const CommandResult result = run_command(view + option, own_folder());
    EXPECT_EQ(result.exit_code, 2) << option << ": " << result.err;
  }
  const std::string help = run_command(view + "--help", own_folder()).out;
  for (const char* option : {"--backend", "--device", "--crop", "--precise"})
    EXPECT_EQ(help.find(option), std::string::npos) << option;
  EXPECT_NE(help.find("--spp"), std::string::npos);
}

TEST(View, SettingsThatContradictAreAUsageErrorBeforeAnythingIsOpened) {
  const CommandResult result =
      run_command("env -u DISPLAY '" PINOCCHIO_PROGRAM "' view '" PINOCCHIO_SOURCE_DIR
                  "/scenes/cornell' --design 2 --exchange reproject",
                  own_folder());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("reproject"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace pinocchio
