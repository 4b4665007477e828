// What is shown over the picture, and what is written to files: marks, edges, numbers, pictures, scenes.
#include "tests/support/stb_image.h"
#include "tests/view/editing.h"

namespace pinocchio {
namespace {

using ShowingTest = EditingTest;

// A scene that is as in its file is named in the command; an edited one is saved for it, which is said. No
// file is replaced.
TEST_F(ShowingTest, PSaysWhichSceneItWrites) {
  std::ofstream(folder_ / "cornell-001.bin") << "mine";
  open_with("Scene", scene("cornell"));
  pause_ms(7000);  // what P said is gone by itself
  settle("quiet.png");
  const std::string messages = "560x60+0+510";
  EXPECT_NE(command_line().find("scenes/cornell"), std::string::npos);
  EXPECT_EQ(lines_of("the scene as it is shown is in"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cornell-001.gltf"));
  click(40, widgets_at(75, 240, 460)[1]);  // hides a part
  xdo(at(700, 500));
  EXPECT_NE(command_line().find("render cornell-002.gltf"), std::string::npos);
  EXPECT_EQ(lines_of("the scene as it is shown is in " + (folder_ / "cornell-002.gltf").string()), 1);
  EXPECT_TRUE(text_of(folder_ / "cornell-001.bin") == "mine");
  settle("said.png");
  EXPECT_GT(different_in(messages, "quiet.png", "said.png"), 500);
  expect_clean_close();
}

// The studio's light was edited: the saved scene has it, and the command gives it the studio's sky.
TEST_F(ShowingTest, PNamesTheSkyOfAnEditedStudio) {
  std::ofstream(folder_ / "corner.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  open_with("Lights", "corner.obj", "--mode raytrace");
  EXPECT_EQ(option(command_line(), "--environment"), "");
  const std::vector<int> rows = widgets_at(121, 30, 560);
  ASSERT_GE(rows.size(), 3u);  // direction, colour, intensity
  drag_from(150, rows[2], -60);
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  settle();
  key("F12");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "corner-001.png"); }));
  std::string command = command_line();
  EXPECT_NE(command.find("render corner-002.gltf"), std::string::npos) << command;
  EXPECT_EQ(option(command, "--environment"), "studio") << command;
  EXPECT_EQ(json_of("corner-002.gltf")["extensions"]["KHR_lights_punctual"]["lights"].size(), 1u);
  command.replace(0, std::string("pinocchio").size(), "'" PINOCCHIO_PROGRAM "'");
  EXPECT_EQ(run_command("cd '" + folder_.string() + "' && " + command, folder_).exit_code, 0) << command;
  // Not quite the same pixels: the light's numbers are rounded in the file.
  EXPECT_EQ(different_in("800x600+0+0", "corner-001.png", "corner-002.png", 1), 0);
  key("ctrl+s");
  expect_clean_close("a studio lights and frames it");
}

// A light's name beside its mark does not touch the edge of its box.
TEST_F(ShowingTest, AMarksLabelHasRoomAroundIt) {
  open_with("Lights", scene("cornell"), "--eye 0,1,3.4 --target 0,1,0 --light 0,1,0,0.5 --mode raster");
  xdo(at(700, 100));
  settle("without.png");
  xdo(at(400, 300));  // the mark, where the camera looks
  settle("with.png");
  // The box, beside the pointer; its corners let what is behind it through.
  const Picture with = picture("with.png"), without = picture("without.png");
  glm::ivec2 lo(800, 600), hi(-1), text_lo(800, 600), text_hi(-1);
  const auto in_box = [&](auto visit) {
    for (int y = 200; y < 400; ++y)
      for (int x = 411; x < 800; ++x)
        if (with.at(x, y) != without.at(x, y)) visit(glm::ivec2(x, y), glm::ivec3(with.at(x, y)));
  };
  in_box([&](const glm::ivec2& p, const glm::ivec3&) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  });
  in_box([&](const glm::ivec2& p, const glm::ivec3& c) {
    const bool is_edge = p.x < lo.x + 3 || p.x > hi.x - 3 || p.y < lo.y + 3 || p.y > hi.y - 3;
    if (is_edge || std::min({c.r, c.g, c.b}) < 150) return;
    text_lo = glm::min(text_lo, p);
    text_hi = glm::max(text_hi, p);
  });
  ASSERT_GT(hi.x, lo.x + 40);
  ASSERT_GT(text_hi.x, text_lo.x + 30);
  EXPECT_GE(text_lo.x - lo.x, 5);
  EXPECT_GE(hi.x - text_hi.x, 5);
  EXPECT_GE(text_lo.y - lo.y, 4);
  EXPECT_GE(hi.y - text_hi.y, 4);
  expect_clean_close();
}

// What F12 writes is the picture alone, with Shift the window.
TEST_F(ShowingTest, AScreenshotHasNoPanels) {
  open_with("Drawing", scene("cornell"));
  key("F12");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-001.png"); }));
  key("shift+F12");
  ASSERT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "cornell-002.png"); }));
  key("h");
  settle("bare.png");
  EXPECT_EQ(different("bare.png", "cornell-001.png"), 0);
  EXPECT_GT(different("bare.png", "cornell-002.png"), 50000);
  expect_clean_close();
}

// Into a folder, by a name; a file that exists stays.
TEST_F(ShowingTest, FilesAreSavedToAFolder) {
  std::filesystem::create_directories(folder_ / "s");
  std::ofstream(folder_ / "triangle.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
  open_with("Save", "triangle.obj", "--light 0,0,5");
  const std::vector<int> rows = widgets_at(118, 30, 170);  // folder, name, scene, picture
  ASSERT_EQ(rows.size(), 4u);
  type(200, rows[0], "s");
  type(200, rows[1], "n");
  const auto exists = [this](const char* file) {
    return becomes([&] { return std::filesystem::exists(folder_ / file); }, 20.0);
  };
  click(118, rows[2]);
  EXPECT_TRUE(exists("s/n.glb"));
  const auto written = std::filesystem::last_write_time(folder_ / "s/n.glb");
  click(118, rows[2]);
  EXPECT_TRUE(becomes([this] { return errors().find("exists") != std::string::npos; }));
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "s/n.glb"), written);
  click(202, rows[3]);  // PNG, transparent
  ASSERT_TRUE(exists("s/n.png"));
  int width = 0, height = 0, channels = 0;
  stbi_uc* const bytes = stbi_load((folder_ / "s/n.png").c_str(), &width, &height, &channels, 4);
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(channels, 4);
  EXPECT_EQ(bytes[3], 0);                              // a corner: nothing is there
  EXPECT_EQ(bytes[4 * (300 * width + 400) + 3], 255);  // the middle: the triangle
  EXPECT_GT(bytes[4 * (300 * width + 400)], 20);
  stbi_image_free(bytes);
  click(287, rows[3]);  // EXR
  EXPECT_TRUE(exists("s/n.exr"));
  expect_clean_close("exists");
}

// A file beside the scene's stays, too, whether the name is typed or not.
TEST_F(ShowingTest, ABinIsNotReplaced) {
  for (const char* file : {"n.bin", "triangle-001.bin"}) std::ofstream(folder_ / file) << "mine";
  std::ofstream(folder_ / "triangle.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
  open_with("Save", "triangle.obj", "--light 0,0,5");
  const std::vector<int> rows = widgets_at(118, 30, 170);  // folder, name, scene, picture
  ASSERT_EQ(rows.size(), 4u);
  const int gltf_x = 160;
  click(gltf_x, rows[2]);
  EXPECT_TRUE(becomes([this] { return std::filesystem::exists(folder_ / "triangle-002.gltf"); }));
  type(200, rows[1], "n");
  click(gltf_x, rows[2]);
  EXPECT_TRUE(becomes([this] { return errors().find("n.bin exists") != std::string::npos; }));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "n.gltf"));
  for (const char* file : {"n.bin", "triangle-001.bin"})
    EXPECT_TRUE(text_of(folder_ / file) == "mine") << file;
  expect_clean_close("exists");
}

TEST_F(ShowingTest, EdgesOfTrianglesAreShown) {
  open_with("Camera", scene("cornell"));
  key("z");
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  settle("edges.png");
  long long amber = 0;
  for (const glm::u8vec3& c : crop(picture("edges.png"), kPicture).pixels())
    if (c.r > 200 && c.g > 120 && c.g < 190 && c.b < 100) ++amber;
  EXPECT_GT(amber, 500);
  key("z");
  EXPECT_TRUE(picture_becomes("opened.png"));
  expect_clean_close();
}

// Enlarged pixels go with R, and with another size of the window.
TEST_F(ShowingTest, EnlargementEnds) {
  open_with("Camera", scene("cornell"));
  const auto enlarge = [this] {
    xdo(at(600, 300) + "keydown ctrl sleep 0.1 click 4 click 4 click 4 click 4 sleep 0.1 keyup ctrl " +
        at(700, 500));
  };
  enlarge();
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  key("r");
  EXPECT_TRUE(picture_becomes("opened.png"));
  enlarge();
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  for (const char* size : {"1280x800", "800x600"}) {
    key("F11");
    EXPECT_TRUE(becomes([&] { return option(command_line(), "--size") == size; }));
  }
  EXPECT_TRUE(picture_becomes("opened.png"));
  enlarge();
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  xdo("windowsize --sync " + window_ + " 640 480");
  settle();  // two sizes at once are one event
  xdo("windowsize --sync " + window_ + " 800 600");
  EXPECT_TRUE(picture_becomes("opened.png"));
  expect_clean_close();
}

TEST_F(ShowingTest, SettingsAreSearched) {
  open_with("All settings", scene("cornell"));
  const std::vector<int> all = widgets_at(200, 30, 580);
  EXPECT_GT(all.size(), 10u);
  click(200, all[0]);
  pause_ms(200);
  key("s e e d");
  xdo(at(700, 500));
  EXPECT_TRUE(becomes([&] {
    settle();
    return widgets_at(200, 30, 580).size() <= 4;  // the search, the table's head, and what was found
  }));
  expect_clean_close();
}

// A file that needs more memory than allowed, for its texture, is opened from its error.
TEST_F(ShowingTest, ARefusedFileIsOpenedAnyway) {
  const std::string corners = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\n";
  std::ofstream(folder_ / "plain.obj") << corners << "f 1 2 3\n";
  std::ofstream(folder_ / "textured.obj") << "mtllib textured.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
                                          << corners << "f 1/1 2/2 3/3\n";
  std::ofstream(folder_ / "textured.mtl") << "newmtl m\nKd 1 1 1\nmap_Kd plain.png\n";
  ASSERT_EQ(
      run_command("cd '" + folder_.string() +
                      "' && '" PINOCCHIO_PROGRAM
                      "' render plain.obj --size 1024x1024 --mode raytrace -o plain.exr --preview plain.png",
                  folder_)
          .exit_code,
      0);
  start({PINOCCHIO_PROGRAM, "view", "textured.obj", "--load-limit", "1", "--spp", "1", "--size", "800x600"});
  ASSERT_TRUE(becomes([this] { return errors().find("--load-limit") != std::string::npos; })) << errors();
  settle();
  click(60, 555);
  EXPECT_TRUE(
      becomes([this] { return xdo("getwindowname " + window_).find("textured") != std::string::npos; }));
  program_.reset();
}

// Far in, each pixel has its three numbers on it, which are hidden with the panels.
TEST_F(ShowingTest, EnlargedPixelsShowTheirLight) {
  open_with("Camera", scene("cornell"));
  std::string all = at(600, 300) + "keydown ctrl sleep 0.1 ";
  for (int i = 0; i < 20; ++i) all += "click 4 sleep 0.02 ";
  xdo(all + "sleep 0.1 keyup ctrl " + at(700, 500));
  settle("numbers.png");
  key("h");
  settle("none.png");
  EXPECT_GT(different_in(kPicture, "numbers.png", "none.png"), 1000);
  EXPECT_LT(different_in(kPicture, "numbers.png", "none.png"), 80000);
  key("h");
  EXPECT_TRUE(picture_becomes("numbers.png"));
  expect_clean_close();
}

}  // namespace
}  // namespace pinocchio
