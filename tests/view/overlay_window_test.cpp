// The window as a person meets it: what covers the picture, where input goes, what it costs to stand still.
#include "core/image/tonemap.h"
#include "pinocchio/exr.h"
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class OverlayTest : public WindowTest {
 protected:
  [[nodiscard]] std::string eye() { return option(command_line(), "--eye"); }
  // Share of the window's pixels that differ between two pictures of it.
  [[nodiscard]] double share_different(const std::string& a, const std::string& b, double pixels) const {
    return static_cast<double>(different(a, b)) / pixels;
  }
  // What the window wrote of itself.
  [[nodiscard]] nlohmann::json pace(const std::string& file) const {
    return nlohmann::json::parse(text_of(folder_ / file));
  }
};

// Eight times from the picture onto a panel, which is dragged and put back, and its wheel, as fast as the
// display takes it. Around the button it takes a moment: window managers hold the pointer while they see to
// the focus, and what comes meanwhile is delivered out of order. The last pause parts it from a double click,
// which folds.
TEST_F(OverlayTest, WhatIsDraggedOnAPanelDoesNotMoveTheCamera) {
  open_as_is(scene("cornell"));
  key(std::string(kStill) + " F3");  // at the right
  settle();
  const std::string before = eye();
  pause_ms(7000);  // what P said is gone by itself
  xdo(at(150, 300));
  settle("before.png");
  std::string all;
  for (int i = 0; i < 8; ++i)
    all += at(150, 300) + at(640, 18) + "mousedown 1 sleep 0.05 " + at(640, 24) + at(500, 200) + at(640, 18) +
           "sleep 0.05 mouseup 1 sleep 0.05 " + at(150, 300) + at(640, 18) + "click 4 " + at(150, 300) +
           "sleep 0.3 ";
  xdo(all);
  settle("after.png");
  EXPECT_EQ(different("before.png", "after.png"), 0);  // the panel is where it was
  EXPECT_EQ(eye(), before);
  // And the other way round: on the picture it does.
  xdo(at(640, 18) + at(150, 300) + "mousedown 1 " + at(190, 300) + "mouseup 1");
  pause_ms(500);
  EXPECT_NE(eye(), before);
  expect_clean_close();
}

TEST_F(OverlayTest, EscapeClosesPopupThenHelpThenFullScreenThenTheWindow) {
  open_as_is(scene("cornell"), "480x360", "--spp 1");
  key("F11");
  ASSERT_TRUE(becomes([this] { return option(command_line(), "--size") == "1280x800"; }, 20.0));
  const std::string popup = "200x200+1060+570", help = "600x300+340+200";
  xdo(at(1167, 790));  // on "Panels", which has its tooltip from now on
  ASSERT_TRUE(becomes([this] { return load(0.5) < 0.05; }));  // the large picture is done
  settle("bare.png");
  key("F1");
  settle("help.png");
  EXPECT_GT(different_in(help, "bare.png", "help.png"), 50000);
  click(1167, 790);
  settle("popup.png");
  EXPECT_GT(different_in(popup, "help.png", "popup.png"), 10000);
  key("Escape");
  settle("without-popup.png");
  EXPECT_EQ(different_in(popup, "help.png", "without-popup.png"), 0);
  EXPECT_EQ(different_in(help, "help.png", "without-popup.png"), 0);
  key("Escape");
  settle("without-help.png");
  EXPECT_EQ(different_in(help, "bare.png", "without-help.png"), 0);
  EXPECT_EQ(option(command_line(), "--size"), "1280x800");  // still full screen
  key("Escape");
  EXPECT_TRUE(becomes([this] { return option(command_line(), "--size") == "480x360"; }, 20.0));
  EXPECT_TRUE(program_->running());
  key("Escape");
  EXPECT_EQ(program_->wait(), 0) << errors();
}

TEST_F(OverlayTest, AStillPictureCostsNothing) {
  open_as_is(scene("cornell"), "320x240", "--spp 4");
  ASSERT_TRUE(becomes([this] { return option(command_line(), "--spp") == "4"; }));
  pause_ms(8000);  // messages are gone, too
  EXPECT_LT(load(5.0), 0.01);
  // And it wakes at once.
  const std::string before = eye();
  drag(1, 40, 0);
  EXPECT_NE(eye(), before);
  expect_clean_close();
}

TEST_F(OverlayTest, PanelsAreRememberedFromRunToRun) {
  open_as_is(scene("cornell"));
  key("F3 F2");
  pause_ms(500);
  expect_clean_close();
  const nlohmann::json json = nlohmann::json::parse(text_of(folder_ / "config/pinocchio/window.json"));
  EXPECT_EQ(json["open"], (nlohmann::json{"Frame times", "Drawing"}));
  ASSERT_EQ(json["recent"].size(), 1u);
  EXPECT_NE(json["recent"][0].get<std::string>().find("cornell.gltf"), std::string::npos);
  // The next run shows them.
  program_.reset();
  std::filesystem::remove(folder_ / "out.txt");
  open_as_is(scene("cornell"));
  key(kStill);
  settle("open.png");
  key("F3 F2");
  settle("closed.png");
  EXPECT_GT(different("open.png", "closed.png"), 30000);
  expect_clean_close();
}

class ScaleTest : public OverlayTest, public testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    OverlayTest::SetUp();
    if (IsSkipped()) return;
    const CommandResult asked = run_command(
        "DISPLAY=" + display_ + " xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi:\t" +
            std::to_string(96 * GetParam()) + "'",
        folder_);
    ASSERT_EQ(asked.exit_code, 0) << asked.err;
  }
};

TEST_P(ScaleTest, AtTheStartThePictureIsUncovered) {
  const int scale = GetParam();
  start({PINOCCHIO_PROGRAM, "view", scene("cornell"), "--size",
         std::to_string(800 / scale) + "x" + std::to_string(600 / scale), "--spp", "1"});
  for (const auto& [width, height] : {std::pair{800, 600}, {480, 360}}) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    xdo("windowsize --sync " + window_ + " " + std::to_string(width) + " " + std::to_string(height));
    ASSERT_TRUE(becomes([&] {
      settle("open.png");
      return picture("open.png").size() == glm::ivec2(width, height);
    }));
    // Until the window has the focus, keys are lost.
    EXPECT_TRUE(becomes([&] {
      xdo("windowfocus --sync " + window_);
      key("h");
      settle("bare.png");
      return different("open.png", "bare.png") > 0;
    })) << size;
    EXPECT_LT(share_different("open.png", "bare.png", 1.0 * width * height), 0.15) << size;
    key("h");
  }
  expect_clean_close();
}

// In 480 by 360 pixels, also where the display asks for all to be twice as large.
TEST_P(ScaleTest, PanelsFitASmallWindow) {
  const int scale = GetParam();
  open_as_is(scene("cornell"), std::to_string(480 / scale) + "x" + std::to_string(360 / scale), "--spp 1");
  EXPECT_EQ(option(command_line(), "--size"), "480x360");
  settle("without.png");
  for (const char* panel : {"F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10"}) {
    key(panel);
    settle("with.png");
    // Its title bar's left and right corner are in the window: the strip of pixels at the window's edges
    // stays.
    EXPECT_EQ(different_in("2x300+0+0", "with.png", "without.png"), 0) << panel;
    EXPECT_GT(different("with.png", "without.png"), 15000 * scale) << panel;  // more than what P said
    key(panel);
  }
  EXPECT_TRUE(program_->running()) << errors();
  expect_clean_close();
}
INSTANTIATE_TEST_SUITE_P(OneAndTwo, ScaleTest, testing::Values(1, 2));

TEST_F(OverlayTest, UndoAndRedo) {
  open(scene("cornell"));
  key(kStill);
  pause_ms(600);
  const std::string before = eye();
  drag(1, 60, 30);
  pause_ms(600);
  const std::string after = eye();
  ASSERT_NE(before, after);
  key("m");
  pause_ms(600);
  ASSERT_EQ(option(command_line(), "--mode"), "raytrace");
  key("ctrl+z");
  EXPECT_EQ(option(command_line(), "--mode"), "");
  key("ctrl+z");
  EXPECT_EQ(eye(), before);
  key("ctrl+y");
  EXPECT_EQ(eye(), after);
  key("ctrl+y");
  EXPECT_EQ(option(command_line(), "--mode"), "raytrace");
  // What was pressed at once before is taken back and done again, too.
  for (int i = 0; i < 3; ++i) xdo("key --delay 0 plus ctrl+z ctrl+y");
  EXPECT_EQ(option(command_line(), "--exposure"), "1.5");
  // Panels that are hidden meanwhile are no step.
  key("h");
  pause_ms(600);
  key("ctrl+z ctrl+z ctrl+z ctrl+z ctrl+z");
  EXPECT_EQ(eye(), before);
  expect_clean_close();
}

TEST_F(OverlayTest, TheCommandSaysHowTheTreeIsBuilt) {
  open(scene("cornell"), "--tree spatial-median --offset scaled --triangle-test watertight --tree-leaf 5");
  const std::string command = command_line();
  EXPECT_EQ(option(command, "--tree"), "spatial-median");
  EXPECT_EQ(option(command, "--offset"), "scaled");
  EXPECT_EQ(option(command, "--triangle-test"), "watertight");
  EXPECT_EQ(option(command, "--tree-leaf"), "5");
  expect_clean_close();
}

// A file that cannot be read is said, on the display and on the terminal, and changes nothing.
TEST_F(OverlayTest, AnUnreadableFileLeavesTheSceneInCharge) {
  for (const char* file : {"cornell.gltf", "cornell.bin"}) std::filesystem::copy(scene(file), folder_ / file);
  std::ofstream(folder_ / "damaged.obj") << "v 0 0 0\nf 1 2 7\n";
  open("cornell.gltf");
  key(kStill);
  const std::string before = command_line();
  key("Right");  // the folder's next
  ASSERT_TRUE(becomes([this] { return errors().find("damaged.obj:2") != std::string::npos; })) << errors();
  EXPECT_EQ(command_line(), before);
  key("Escape");
  EXPECT_EQ(program_->wait(), 0);
}

TEST_F(OverlayTest, ArrowsStepThroughTheFolder) {
  for (const char* file : {"cornell.gltf", "cornell.bin", "speedboat.glb"})
    std::filesystem::copy(scene(file), folder_ / file);
  open("cornell.gltf");
  key("Right");
  EXPECT_TRUE(becomes([this] { return command_line().find("speedboat.glb") != std::string::npos; }));
  EXPECT_NE(command_line().find("-o speedboat-001.exr"), std::string::npos);
  key("Left");
  EXPECT_TRUE(becomes([this] { return command_line().find("cornell.gltf") != std::string::npos; }));
  expect_clean_close();
}

// The window is drawn while a large scene is read and its tree is built, to the end.
TEST_F(OverlayTest, LoadingDoesNotFreezeTheWindow) {
  ASSERT_EQ(
      run_command("cd '" + folder_.string() +
                      "' && '" PINOCCHIO_PROGRAM "' generate spd:balls --triangles 1000000 -o balls.glb",
                  folder_)
          .exit_code,
      0);
  start({PINOCCHIO_PROGRAM, "view", "balls.glb", "--size", "320x240", "--spp", "1", "--stats-json",
         "pace.json"});
  xdo("windowfocus --sync " + window_);
  // The bar moves while it loads: at least four times in ten looks, of two seconds.
  int changes = 0;
  grab("progress-0.png");
  for (int i = 1; i <= 10; ++i) {
    pause_ms(200);
    grab("progress-1.png");
    if (different("progress-0.png", "progress-1.png") > 0) ++changes;
    pictures_["progress-0.png"] = pictures_["progress-1.png"];
  }
  EXPECT_GE(changes, 4);
  EXPECT_TRUE(becomes([this] { return load(0.5) < 0.05; }));  // the tree is built, the picture is done
  expect_clean_close();
  const nlohmann::json loading = pace("pace.json")["between_redraws_while_loading"];
  EXPECT_GT(loading["count"].get<int>(), 4) << loading;  // scripts/window pace tells how often
}

// While a still camera's samples are gathered.
TEST_F(OverlayTest, AnswersWhileSamplesAreGathered) {
  open_as_is(scene("cornell"), "800x600", "--spp 4096 --stats-json pace.json");
  for (int i = 0; i < 10; ++i) {
    key(i % 2 ? "minus" : "plus");
    pause_ms(150);
    key("F3");
    pause_ms(150);
  }
  expect_clean_close();
  const nlohmann::json answers = pace("pace.json")["input_to_display"];
  EXPECT_GE(answers["count"].get<int>(), 20) << answers;  // scripts/window pace tells how soon
}

TEST_F(OverlayTest, SequencesAreRecorded) {
  open(scene("cornell"), "--spp 4");
  const auto exists = [this](const char* file) { return std::filesystem::exists(folder_ / file); };
  key("shift+k");
  drag(1, 40, 10);
  EXPECT_TRUE(becomes([&] { return exists("cornell-001-0003.exr"); }));
  key("k");
  EXPECT_TRUE(exists("cornell-001-0002.png"));
  // The same frame: the screen's bytes are those of the file's light, as the GPU rounds.
  const Expected<ExrFile> light = read_exr(folder_ / "cornell-001-0002.exr");
  ASSERT_TRUE(light);
  Image<glm::vec4> color(light->data_window.size());
  for (std::size_t i = 0; i < color.pixels().size(); ++i)
    color[i] = {light->find("R")->values[i], light->find("G")->values[i], light->find("B")->values[i], 1.0f};
  EXPECT_EQ(different_pixels(preview(color, 0.0f), picture("cornell-001-0002.png"), 1), 0);
  // Pictures alone, which go on where the camera goes.
  key("k");
  drag(1, 40, 10);
  EXPECT_TRUE(becomes([&] { return exists("cornell-002-0003.png"); }));
  key("k");
  EXPECT_FALSE(exists("cornell-002-0001.exr"));
  EXPECT_GT(different("cornell-002-0001.png", "cornell-002-0003.png"), 100);
  expect_clean_close();
}

TEST_F(OverlayTest, ChangedMaterialsAreSavedAsGltf) {
  open(scene("cornell"));
  key("ctrl+s");
  EXPECT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-001.gltf"); }));
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
