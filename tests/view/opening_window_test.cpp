// Scenes that are opened while another is shown: dropped, clicked at, cancelled.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class OpeningTest : public WindowTest {
 protected:
  void copy_scenes(const std::vector<std::string>& files) const {
    for (const std::string& file : files) std::filesystem::copy(scene(file), folder_ / file);
  }
  // As a file manager does, into the middle; whether the window has taken it.
  [[nodiscard]] bool drop(const std::string& file) const {
    return run_command("DISPLAY=" + display_ + " '" PINOCCHIO_DROP_FILE "' " + window_ + " 300 300 'file://" +
                           (folder_ / file).string() + "'",
                       folder_)
               .exit_code == 0;
  }
  [[nodiscard]] bool shows(const std::string& file, double seconds = 60.0) {
    return becomes([&] { return command_line().find(file) != std::string::npos; }, seconds);
  }
};

// Also one with a blank in its name, which is a %20 on the way.
TEST_F(OpeningTest, ADroppedFileIsOpenedAndABadOneChangesNothing) {
  copy_scenes({"cornell.gltf", "cornell.bin", "speedboat.glb"});
  std::filesystem::rename(folder_ / "speedboat.glb", folder_ / "speed boat.glb");
  std::ofstream(folder_ / "damaged.obj") << "v 0 0 0\nf 1 2 7\n";
  open("cornell.gltf", "--spp 1");
  const std::string before = command_line();
  settle("before.png");
  for (const char* bad : {"damaged.obj", "missing.obj"}) {
    ASSERT_TRUE(drop(bad)) << bad;
    EXPECT_TRUE(becomes([&] { return errors().find(bad) != std::string::npos; })) << errors();
  }
  EXPECT_EQ(std::ranges::count(errors(), '\n'), 2) << errors();
  EXPECT_EQ(command_line(), before);
  drag(1, 40, 10);  // the old scene is drawn as before
  key("r");
  settle("after.png");
  EXPECT_EQ(different_in("320x60+0+0", "before.png", "after.png"), 0);  // above the messages
  ASSERT_TRUE(drop("speed%20boat.glb"));
  EXPECT_TRUE(shows("speed boat.glb"));
  key("Escape");
  EXPECT_EQ(program_->wait(), 0);
}

// It lights the scene and is seen behind it, in the command and in the window; and is taken back.
TEST_F(OpeningTest, ADroppedEnvironmentLightsTheScene) {
  std::ofstream(folder_ / "triangle.obj") << "v -0.3 0 0\nv 0.3 0 0\nv 0 0.3 0\nf 1 2 3\n";
  std::ofstream sky(folder_ / "sky.hdr", std::ios::binary);
  sky << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
  for (int i = 0; i < 8 * 16; ++i) sky << "\x20\x40\x7f\x80";  // blue
  sky.close();
  open("triangle.obj", "--spp 1 --light 0,1,2");
  settle("before.png");
  const std::string top = "24x40+0+0";  // beside the triangle
  ASSERT_TRUE(drop("sky.hdr"));
  EXPECT_TRUE(becomes([&] {
    grab("blue.png");
    const std::array<double, 3> mean = mean_of(crop(picture("blue.png"), top));
    return mean[2] > mean[0] + 0.2;
  })) << errors();
  EXPECT_NE(option(command_line(), "--environment").find("sky.hdr"), std::string::npos);
  EXPECT_EQ(lines_of("triangle-001.gltf"), 0);  // the scene itself is as in its file
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(becomes([&] {
    grab("back.png");
    return different_in(top, "before.png", "back.png") == 0;
  }));
  key("ctrl+y");
  EXPECT_TRUE(becomes([&] {
    grab("again.png");
    return different_in(top, "blue.png", "again.png") == 0;
  }));
  expect_clean_close();
}

// While it is read: text, which takes a second at least; then while its tree is built.
TEST_F(OpeningTest, CancelKeepsWhatIsShown) {
  copy_scenes({"cornell.gltf", "cornell.bin"});
  ASSERT_EQ(
      run_command("cd '" + folder_.string() +
                      "' && '" PINOCCHIO_PROGRAM "' generate spd:balls --triangles 1000000 -o large.obj",
                  folder_)
          .exit_code,
      0);
  open("cornell.gltf", "--mode raster --spp 1 --threads 1");  // so that a tree takes long enough to click
  // The button is at the left, below one line of words or two. One command does it all: between two, a tree
  // could be built.
  const auto cancel_after = [this](const std::string& pressed, int rounds) {
    std::string does = "key --delay 40 " + pressed + " ";
    for (int round = 0; round < rounds; ++round)
      for (const int y : {36, 53})
        for (int x = 30; x <= 90; x += 15) does += at(x, y) + "sleep 0.02 click 1 ";
    xdo(does);
  };
  const auto rests = [this] { return becomes([this] { return load(1.0) < 0.05; }); };
  const std::string eye = option(command_line(), "--eye");
  cancel_after("Right", 3);
  EXPECT_TRUE(rests());
  EXPECT_NE(command_line().find("cornell.gltf"), std::string::npos);
  EXPECT_TRUE(rests());  // nothing comes later
  EXPECT_NE(command_line().find("cornell.gltf"), std::string::npos);
  EXPECT_EQ(option(command_line(), "--eye"), eye);
  key("Right");  // and not cancelled it is opened
  ASSERT_TRUE(becomes([this] { return xdo("getwindowname " + window_).find("large") != std::string::npos; }));
  xdo(at(160, 200));
  EXPECT_TRUE(rests());
  settle("raster.png");
  cancel_after("m", 6);  // into mode hybrid, which wants a tree
  EXPECT_TRUE(rests());
  EXPECT_NE(option(command_line(), "--mode"), "raster");
  // Without it the GPU draws alone, as in mode raster.
  xdo(at(160, 200));
  settle("cancelled.png");
  EXPECT_EQ(different_in("320x150+0+0", "cancelled.png", "raster.png"), 0);  // above the messages
  expect_clean_close("no light");
}

// A scene of the folder is clicked at; the next run, in another folder, has it in its list of recent files.
TEST_F(OpeningTest, AFileIsOpenedFromThePanelAndIsAmongTheRecent) {
  copy_scenes({"cornell.gltf", "cornell.bin", "speedboat.glb"});
  remember("Files", 8, 8);
  open_as_is("cornell.gltf", "800x600", "--spp 1");
  const auto click_line_from_below = [this](std::size_t number) {
    settle();
    const std::vector<int> lines = lines_of_panel(12, 30);
    ASSERT_GE(lines.size(), number);
    click(60, lines[lines.size() - number]);
  };
  click_line_from_below(3);  // below are "Recent" and the scene that is shown
  EXPECT_TRUE(shows("speedboat.glb"));
  expect_clean_close();
  program_.reset();
  std::filesystem::remove(folder_ / "out.txt");
  open_as_is(scene("two-lights"), "800x600", "--spp 1");  // the panel is still open
  click_line_from_below(2);                               // what was shown before it is the last
  EXPECT_TRUE(shows("speedboat.glb"));
  expect_clean_close();
}

// The panel has the folder's environments, too: one that is clicked at lights the scene that is shown.
TEST_F(OpeningTest, AnEnvironmentIsOpenedFromThePanel) {
  std::ofstream(folder_ / "triangle.obj") << "v -0.3 0 0\nv 0.3 0 0\nv 0 0.3 0\nf 1 2 3\n";
  std::ofstream(folder_ / "sky.hdr", std::ios::binary)
      << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x20\x40\x7f\x80\x20\x40\x7f\x80";
  remember("Files", 8, 8);
  open_as_is("triangle.obj", "800x600", "--spp 1 --light 0,1,2");
  settle();
  const std::vector<int> lines = lines_of_panel(12, 30);
  ASSERT_GE(lines.size(), 4u);  // the folder above, sky, triangle, "Recent" and triangle
  click(60, lines[lines.size() - 4]);
  EXPECT_TRUE(becomes([this] { return !option(command_line(), "--environment").empty(); }));
  EXPECT_NE(command_line().find("render triangle.obj"), std::string::npos);
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
