// The window, looked at closely and edited: what panels, clicks with keys held, and the wheel do.
#include "core/image/tonemap.h"
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class LookingTest : public WindowTest {
 protected:
  // What P prints while the camera flies: as long as nothing moves, a budget gives up nothing.
  std::string moving_command() {
    const long before = lines_of("pinocchio render");
    xdo("keydown s sleep 0.4 key p sleep 0.3 keyup s key r");
    if (!becomes([&] { return lines_of("pinocchio render") > before; }, 10.0)) return {};
    const std::string all = text_of(folder_ / "out.txt");
    const std::size_t at = all.rfind("pinocchio render");
    return all.substr(at, all.find('\n', at) - at);
  }
};

// Something of a frame for its time; which is fastest, by times that were measured.
bool gave_up(const std::string& command) {
  for (const char* what : {"--mask-bits 0", "--mask-scale", "--reflection", "--depth"})
    if (command.find(what) != std::string::npos) return true;
  return false;
}

TEST_F(LookingTest, ControlShiftAndAClickSetTheExposure) {
  open(scene("cornell"));
  key(kStill);
  EXPECT_EQ(option(command_line(), "--exposure"), "");
  EXPECT_TRUE(becomes(
      [this] {
        click_with("ctrl keydown shift", 160, 120);
        return !option(command_line(), "--exposure").empty();
      },
      20.0));
  expect_clean_close();
}

TEST_F(LookingTest, ADoubleClickSetsThePivot) {
  open(scene("cornell"));
  key(kStill);
  const std::string target = option(command_line(), "--target"), eye = option(command_line(), "--eye");
  EXPECT_TRUE(becomes(
      [&] {
        xdo(at(100, 160) + "sleep 0.5 click 1 sleep 0.05 click 1");
        return option(command_line(), "--target") != target;
      },
      20.0));
  EXPECT_EQ(option(command_line(), "--eye"), eye);
  expect_clean_close();
}

// Squares of one colour: a pixel is as its right neighbour, mostly.
TEST_F(LookingTest, TheWheelWithControlEnlargesPixels) {
  open(scene("cornell"));
  key(kStill);
  xdo(at(160, 120));
  settle("whole.png");
  xdo("keydown ctrl sleep 0.05 click --repeat 10 --delay 30 4 sleep 0.05 keyup ctrl");
  settle("large.png");
  EXPECT_GT(different("whole.png", "large.png"), 1000);
  const auto steps = [this](const std::string& name) {  // from a pixel to its right neighbour
    return different_pixels(crop(picture(name), "319x240+0+0"), crop(picture(name), "319x240+1+0"));
  };
  EXPECT_LT(2 * steps("large.png"), steps("whole.png"));
  EXPECT_EQ(option(command_line(), "--size"), "320x240");  // what is drawn is the same
  xdo(at(160, 120) + "keydown ctrl sleep 0.05 click --repeat 12 --delay 30 5 sleep 0.05 keyup ctrl");
  settle("back.png");
  EXPECT_EQ(different("whole.png", "back.png"), 0);
  expect_clean_close();
}

TEST_F(LookingTest, ThePanelPixelFollowsThePointer) {
  open_as_is(scene("cornell"));
  key(std::string(kStill) + " F8");
  ASSERT_TRUE(becomes(
      [&] {
        xdo(at(200, 150));
        settle("one.png");
        xdo(at(300, 400));
        settle("other.png");
        return different_in("340x300+452+270", "one.png", "other.png") > 200;
      },
      30.0));
  EXPECT_EQ(different_in("400x500+0+0", "one.png", "other.png"), 0);  // the picture stands still
  expect_clean_close();
}

// The panel Drawing has it: brighter, more is shown as white, and the bars move.
TEST_F(LookingTest, TheHistogramFollowsTheExposure) {
  open_as_is(scene("cornell"));
  key(std::string(kStill) + " F3");
  settle("before.png");
  key("plus plus");
  settle("after.png");
  EXPECT_GT(different_in("350x420+442+0", "before.png", "after.png"), 1000);
  key("minus minus");
  settle("again.png");
  EXPECT_EQ(different_in("350x420+442+0", "before.png", "again.png"), 0);
  expect_clean_close();
}

// Ctrl and a click: its panel opens, and the camera stays.
TEST_F(LookingTest, AMaterialIsPickedByAClick) {
  open_as_is(scene("cornell"), "800x600");
  key(kStill);
  const std::string eye = option(command_line(), "--eye");
  settle("before.png");
  ASSERT_TRUE(becomes(
      [this] {
        click_with("ctrl", 150, 300);
        settle("panel.png");
        return different_in("320x500+470+50", "before.png", "panel.png") > 20000;
      },
      30.0));
  EXPECT_EQ(command_line().find("cornell-001.gltf"), std::string::npos);  // nothing was changed yet
  EXPECT_EQ(option(command_line(), "--eye"), eye);
  expect_clean_close();
}

// From outside, where its walls are one grey box, F goes in to what stands in it.
TEST_F(LookingTest, FShowsWhatIsInARoom) {
  open(scene("two-lights"), "--spp 1 --eye 0,5,60 --target 0,2,0");
  settle("outside.png");
  key("f");
  EXPECT_TRUE(becomes([this] { return load(0.5) < 0.05; }));
  settle("inside.png");
  EXPECT_LT(count_colors(picture("outside.png")), 100u);
  EXPECT_GT(count_colors(picture("inside.png")), 2000u);
  expect_clean_close();
}

// What it gives up is in the command, while the camera moves.
TEST_F(LookingTest, ABudgetIsKeptAndSaid) {
  open(scene("two-lights"), "--budget 1ms");
  std::string command;
  EXPECT_TRUE(becomes(
      [&] {
        command = moving_command();
        return gave_up(command);
      },
      120.0))
      << command;
  expect_clean_close();
}

// As far from the exact picture as it may be, and no farther.
TEST_F(LookingTest, AnErrorLimitIsKeptAndSaid) {
  open(scene("two-lights"), "--max-error flip=0.1");
  key(kStill);
  std::string command;
  EXPECT_TRUE(becomes(
      [&] {
        command = moving_command();
        return gave_up(command);
      },
      120.0))
      << command;
  expect_clean_close();
  const std::string there = "cd '" + folder_.string() + "' && '" PINOCCHIO_PROGRAM "' ";
  const std::string view = " --size 320x240 --eye " + option(command, "--eye") + " --target " +
                           option(command, "--target") + " --fov " + option(command, "--fov");
  EXPECT_EQ(run_command(there + command.substr(std::string("pinocchio ").size()), folder_).exit_code, 0)
      << command;
  EXPECT_EQ(run_command(there + "render " + scene("two-lights") + view + " -o exact.exr", folder_).exit_code,
            0);
  // What was fastest is given up, by times that were measured: now and then bounces that nothing is seen of.
  EXPECT_EQ(
      run_command(there + "compare exact.exr " + option(command, "-o") + " --max-error flip=0.1", folder_)
          .exit_code,
      0);
}

// Everything that changes the picture, on the command line: the command says it, and draws what the window
// shows.
TEST_F(LookingTest, TheCommandSaysWhatTheCommandLineDid) {
  // A sky of two pixels: Radiance, without run lengths.
  std::ofstream(folder_ / "sky.hdr", std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                                       << std::string("\x80\x90\xa0\x80\x40\x30\x20\x80", 8);
  const std::vector<std::pair<std::string, std::string>> options{{"--environment", "sky.hdr"},
                                                                 {"--environment-rotation", "30"},
                                                                 {"--environment-strength", "0.5"},
                                                                 {"--indirect", "2"},
                                                                 {"--sequence", "random"},
                                                                 {"--seed", "7"},
                                                                 {"--pixel-filter", "blackman-harris"},
                                                                 {"--lens-radius", "0.01"},
                                                                 {"--focus", "3"},
                                                                 {"--max-noise", "0.25"},
                                                                 {"--terminator", "off"},
                                                                 {"--tone-map", "aces"},
                                                                 {"--exposure", "0.5"},
                                                                 {"--load-limit", "2048"}};
  std::string all;
  for (const auto& [name, value] : options) all += (all.empty() ? "" : " ") + name + " " + value;
  open(scene("cornell"), all);
  key(kStill);
  const std::string command = command_line();
  for (const auto& [name, value] : options) EXPECT_EQ(option(command, name), value) << name;
  settle();
  key("F12");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-001.png"); }));
  expect_clean_close();
  const std::string there = "cd '" + folder_.string() + "' && ", program = "'" PINOCCHIO_PROGRAM "'";
  std::string headless = command;
  headless.replace(0, std::string("pinocchio").size(), program);
  headless.replace(headless.find("-o cornell-001.exr"), 18, "-o headless.exr");
  headless.replace(headless.find("--preview cornell-001.png"), 25, "--preview headless.png");
  EXPECT_EQ(run_command(there + headless, folder_).exit_code, 0) << headless;
  const CommandResult compared =
      run_command(there + program + " compare headless.exr cornell-001.exr --max-error max=0", folder_);
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err;
}

TEST_F(LookingTest, TheCommandSaysTheTimeOfAnAnimation) {
  open(scene("windmill"));
  key("ctrl+Right ctrl+Right");
  EXPECT_TRUE(becomes([this] { return !option(command_line(), "--time").empty(); }, 10.0)) << command_line();
  expect_clean_close();
}

// A colour as it is given, whatever the exposure; nothing as chequers of two greys.
TEST_F(LookingTest, BackgroundsAreShown) {
  std::ofstream(folder_ / "triangle.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
  const auto corner = [&](const std::string& background) {
    open("triangle.obj", "--light 0,0,5 --exposure 1 --background " + background);
    settle("shown.png");
    expect_clean_close();
    return crop(picture("shown.png"), "48x48+0+0");
  };
  const Picture color = corner("0.2,0.4,0.6"), chequers = corner("transparent");
  ASSERT_FALSE(color.empty());
  EXPECT_EQ(count_colors(color), 1u);
  EXPECT_EQ(color[0], glm::u8vec3(linear_to_srgb8(0.2f), linear_to_srgb8(0.4f), linear_to_srgb8(0.6f)));
  EXPECT_EQ(count_colors(chequers), 2u);
}

}  // namespace
}  // namespace pinocchio
