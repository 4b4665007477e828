// Edits that are not saved, and what would drop them: Esc, the window's close button, other files.
#include "tests/view/display.h"

namespace pinocchio {
namespace {

class LeavingTest : public WindowTest {
 protected:
  // The panel Lights is open, and the next scene of the folder is speedboat.glb.
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    for (const char* file : {"cornell.gltf", "cornell.bin", "speedboat.glb"})
      std::filesystem::copy(scene(file), folder_ / file);
    remember("Lights", 8, 8);
    open_as_is("cornell.gltf", "800x600", "--spp 1 --mode raster");
  }
  [[nodiscard]] std::vector<int> rows() {
    settle();
    return widgets_at(8 + 112, 8 + 22, 300);
  }
  // The lamp gets darker.
  void edit() {
    const std::vector<int> fields = rows();
    ASSERT_GE(fields.size(), 3u);  // position, colour, intensity
    grab("before.png");
    const int y = fields[2];
    xdo(at(150, y) + "sleep 0.1 mousedown 1 sleep 0.05 " + at(120, y) + "sleep 0.05 " + at(90, y) +
        "sleep 0.05 mouseup 1 sleep 0.05 " + at(700, 20));
    EXPECT_TRUE(becomes([&] {
      grab("edited.png");
      return different_in("400x300+400+50", "before.png", "edited.png") > 5000;
    }));
    settle("edited.png");
  }
  [[nodiscard]] bool shows(const std::string& file, double seconds = 20.0) const {
    return becomes([&] { return xdo("getwindowname " + window_).find(file) != std::string::npos; }, seconds);
  }
  // The question is in the middle of the window.
  [[nodiscard]] bool asks() {
    return becomes([this] {
      grab("asks.png");
      return different_in("200x60+300+210", "edited.png", "asks.png") > 3000;
    });
  }
  [[nodiscard]] bool saved() const { return std::filesystem::exists(folder_ / "cornell-001.gltf"); }
};

TEST_F(LeavingTest, EscapeClosesThePanelThenAsksAndSaves) {
  ASSERT_NO_FATAL_FAILURE(edit());
  key("Escape");
  EXPECT_TRUE(becomes([this] { return rows().empty(); }));  // the panel is closed, the window is not
  key("Escape");
  EXPECT_TRUE(asks());
  key("Escape");  // stay
  settle("stays.png");
  EXPECT_LT(different_in("180x60+315+210", "edited.png", "stays.png"), 100);
  EXPECT_TRUE(program_->running());
  EXPECT_FALSE(saved());
  key("Escape");
  EXPECT_TRUE(asks());
  key("Return");
  EXPECT_EQ(program_->wait(), 0) << errors();
  EXPECT_TRUE(saved());
  EXPECT_NE(text_of(folder_ / "out.txt").find((folder_ / "cornell-001.gltf").string()), std::string::npos);
}

TEST_F(LeavingTest, AnotherFileIsOpenedAfterTheAnswer) {
  ASSERT_NO_FATAL_FAILURE(edit());
  key("Right");
  EXPECT_TRUE(asks());
  key("m");  // other keys do nothing meanwhile
  key("Escape");
  EXPECT_FALSE(shows("speedboat", 1.0));
  key("Right");
  EXPECT_TRUE(asks());
  key("x");
  EXPECT_TRUE(shows("speedboat"));
  EXPECT_FALSE(saved());
  key("Left");  // nothing is edited: no question
  EXPECT_TRUE(shows("cornell"));
  expect_clean_close();
}

TEST_F(LeavingTest, TheCloseButtonAsksAndItsAnswerCanBeClicked) {
  ASSERT_NO_FATAL_FAILURE(edit());
  xdo("windowfocus --sync " + window_ + " key alt+F4");
  EXPECT_TRUE(asks());
  EXPECT_TRUE(program_->running());
  const std::vector<int> buttons = widgets_at(334, 200, 320);
  ASSERT_FALSE(buttons.empty());
  click(340, buttons.back());  // drop the edits
  EXPECT_EQ(program_->wait(), 0) << errors();
  EXPECT_FALSE(saved());
}

TEST_F(LeavingTest, EditsThatAreTakenBackOrSavedAreNotAskedFor) {
  ASSERT_NO_FATAL_FAILURE(edit());
  pause_ms(500);
  key("ctrl+z");
  settle();
  key("Right");
  EXPECT_TRUE(shows("speedboat"));
  key("Left");
  EXPECT_TRUE(shows("cornell"));
  ASSERT_NO_FATAL_FAILURE(edit());
  key("ctrl+s");
  EXPECT_TRUE(becomes([this] { return saved(); }));
  key("Escape Escape");
  EXPECT_EQ(program_->wait(), 0) << errors();
}

// Right goes on behind a file that cannot be read.
TEST_F(LeavingTest, ABrokenFileIsSteppedOver) {
  std::ofstream(folder_ / "damaged.obj") << "v 0 0 0\nf 1 2 7\n";
  key("Right");
  ASSERT_TRUE(becomes([this] { return errors().find("damaged.obj:2") != std::string::npos; })) << errors();
  EXPECT_TRUE(shows("cornell"));
  key("Right");
  EXPECT_TRUE(shows("speedboat"));
  key("Left");
  ASSERT_TRUE(becomes([this] { return std::ranges::count(errors(), '\n') == 2; })) << errors();
  key("Left");
  EXPECT_TRUE(shows("cornell"));
}

class FirstFileTest : public WindowTest {};

// The window opens with what is wrong in it; the exit code tells scripts.
TEST_F(FirstFileTest, ABrokenFileAtTheStartIsSaidInTheWindow) {
  for (const char* file : {"cornell.gltf", "cornell.bin"}) std::filesystem::copy(scene(file), folder_ / file);
  std::ofstream(folder_ / "broken.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n";
  start({PINOCCHIO_PROGRAM, "view", "broken.obj", "--spp", "1"});
  EXPECT_TRUE(
      becomes([this] { return errors().find("broken.obj:4: a face names vertex 7") != std::string::npos; }));
  settle("said.png");
  const std::vector<int> rows = brightness(30, 500, 300, 70);
  EXPECT_GT(*std::ranges::max_element(rows), 100);
  // A person opens another one.
  EXPECT_TRUE(becomes([this] {
    xdo("windowfocus --sync " + window_);
    key("Right");
    return xdo("getwindowname " + window_).find("cornell") != std::string::npos;
  }));
  program_.reset();
  start({PINOCCHIO_PROGRAM, "view", "broken.obj", "--spp", "1"});
  settle();
  for (int presses = 0; presses < 5 && program_->running(); ++presses) {
    xdo("windowfocus --sync " + window_);
    key("Escape");
    (void)program_->wait(2.0);
  }
  EXPECT_EQ(program_->wait(), 4);
}

// Warnings of one file make one message, and go with the file.
TEST_F(FirstFileTest, WarningsDoNotPileUp) {
  const std::string mesh = "v -1 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  for (const char* name : {"a", "b", "c"}) {
    std::ofstream(folder_ / (std::string(name) + ".obj")) << "mtllib " << name << ".mtl\n" << mesh;
    std::ofstream(folder_ / (std::string(name) + ".mtl"))
        << "newmtl m\nKd 0.5 0.5 0.5\nrefl y.png\ndisp z.png\nmap_Ns x.png\ndecal d.png\n";
  }
  remember("Save", 8, 480);  // where warnings are
  open_as_is("a.obj", "800x600", "--spp 1 --light 0,1,2");
  const auto amber_rows = [this] {  // rows of amber letters
    settle();
    const Picture shown = crop(picture("still"), "560x500+8+60");
    std::vector<int> rows;
    for (int y = 0; y < shown.size().y; ++y) {
      int amber = 0;
      for (int x = 0; x < shown.size().x; ++x)
        if (const glm::u8vec3 c = shown.at(x, y); c.r > 180 && c.g > 110 && c.b < 140 && c.r > c.b + 80)
          ++amber;
      rows.push_back(amber > 1 ? 255 : 0);
    }
    return runs(rows, 60, 100, 4, 40).size();
  };
  EXPECT_TRUE(becomes([&] { return amber_rows() > 0; }));  // in front of the panel
  const std::size_t first = amber_rows();
  EXPECT_LE(first, 2u);
  for (const char* name : {"b.obj", "c.obj"}) {
    key("Right");
    EXPECT_TRUE(becomes([&] { return xdo("getwindowname " + window_).find(name) != std::string::npos; }));
  }
  pause_ms(8000);  // news are gone
  EXPECT_EQ(amber_rows(), first);
  program_.reset();
}

class BudgetTest : public WindowTest {
 protected:
  void open_still(const std::string& options) {
    remember("Drawing", 400, 8);
    open_as_is(scene("two-lights"), "800x600", "--spp 1 --exchange sync" + options);
    xdo(at(20, 500));
    pause_ms(9000);  // messages are gone
  }
};

// Nothing keeps it: as much as possible is given up while the camera moves, which P tells, and nothing of a
// still picture.
TEST_F(BudgetTest, AStillPictureIsExactAndWhatWasGivenUpIsSaid) {
  open_still("");
  settle("exact.png");
  const std::string options = command_line();
  const auto rows_of_panel = [this] { return lines_of_panel(404, 30).size(); };
  const std::size_t lines = rows_of_panel();
  expect_clean_close();
  program_.reset();
  std::filesystem::remove(folder_ / "out.txt");
  open_still(" --budget 0.1ms");
  EXPECT_TRUE(becomes([&] {
    settle("still.png");
    return different_in("380x400+0+0", "exact.png", "still.png") == 0;
  }));
  EXPECT_GT(rows_of_panel(), lines);  // the panel says what is given up
  EXPECT_EQ(option(command_line(), "--reflection"), option(options, "--reflection"));
  EXPECT_EQ(option(command_line(), "--mask-bits"), option(options, "--mask-bits"));
  xdo("keydown w sleep 1 key p sleep 0.2 keyup w");
  EXPECT_TRUE(becomes([this] { return lines_of("--reflection none") > 0; })) << text_of(folder_ / "out.txt");
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
