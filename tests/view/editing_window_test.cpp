// What panels change in the scene and write to files: lights, cameras, parts, animations, pictures.
#include "tests/support/stb_image.h"
#include "tests/view/display.h"

namespace pinocchio {
namespace {

constexpr const char* kPicture = "380x400+410+40";  // right of the panels, above messages

class EditingTest : public WindowTest {
 protected:
  // One panel is at (8, 8); one sample a pixel, so that pictures stand still.
  void open_with(const std::string& panel, const std::string& scene_file, const std::string& options = "") {
    remember(panel, 8, 8);
    open_as_is(scene_file, "800x600", "--spp 1 " + options);
    settle("opened.png");
  }
  void drag_from(int x, int y, int by) const {
    xdo(at(x, y) + "sleep 0.1 mousedown 1 sleep 0.05 " + at(x + by / 2, y) + "sleep 0.05 " + at(x + by, y) +
        "sleep 0.05 mouseup 1 sleep 0.05 " + at(700, 500));  // off it: no tooltip
  }
  // Ctrl + click on a number, or a click on a text, and the keys of what replaces it.
  void type(int x, int y, const std::string& keys) const {
    click_with("ctrl", x, y);
    pause_ms(200);
    key("ctrl+a " + keys + " Return");
    xdo(at(700, 500));
  }
  [[nodiscard]] bool picture_becomes_other(const std::string& than) {
    return becomes([&] {
      grab("other.png");
      return different_in(kPicture, than, "other.png") > 1000;
    });
  }
  [[nodiscard]] bool picture_becomes(const std::string& before) {
    return becomes([&] {
      grab("same.png");
      return different_in(kPicture, before, "same.png") == 0;
    });
  }
  [[nodiscard]] nlohmann::json json_of(const std::string& file) const {
    return nlohmann::json::parse(text_of(folder_ / file), nullptr, false);
  }
  // The scene as it was edited, which P saves for its command.
  [[nodiscard]] nlohmann::json saved() {
    const std::string command = command_line();
    const std::string file = command.substr(std::string("pinocchio render ").size());
    return json_of(file.substr(0, file.find(' ')));
  }
  [[nodiscard]] std::array<double, 3> vector_option(const std::string& name) {
    std::array<double, 3> v{};
    std::sscanf(option(command_line(), name).c_str(), "%lf,%lf,%lf", &v[0], &v[1], &v[2]);
    return v;
  }
};

// A point light and parallel light; each is in the saved scene, can be coloured, and is gone once removed.
TEST_F(EditingTest, LightsAreAddedColouredAndRemoved) {
  open_with("Lights", scene("cornell"), "--mode raster");
  const auto lights = [this] { return saved()["extensions"]["KHR_lights_punctual"]["lights"]; };
  // Position, colour, intensity, radius; kinds to add; background, shadows on the ground.
  const std::vector<int> first = widgets_at(121, 30, 560);
  ASSERT_EQ(first.size(), 7u);
  click(40, first[4]);
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  ASSERT_EQ(lights().size(), 2u);
  EXPECT_EQ(lights()[1]["type"], "point");
  settle("two.png");
  drag_from(150, widgets_at(150, 30, 560)[1], -150);  // the first light's red
  EXPECT_TRUE(picture_becomes_other("two.png"));
  const nlohmann::json color = lights()[0]["color"];
  EXPECT_LT(color[0].get<double>(), 0.5 * color[1].get<double>()) << color;
  settle();
  const std::vector<int> rows = widgets_at(121, 30, 590);
  ASSERT_GE(rows.size(), 9u);
  click(121, rows[8]);  // parallel light
  EXPECT_TRUE(becomes([&] { return lights().size() == 3; }));
  EXPECT_EQ(lights()[2]["type"], "directional");
  settle("three.png");
  click(28, widgets_at(28, 26, 60).front());  // removes the first
  EXPECT_TRUE(picture_becomes_other("three.png"));
  EXPECT_EQ(lights().size(), 2u);
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(becomes([&] { return lights().size() == 3; }));
  key("ctrl+s");
  expect_clean_close();
}

// A mark's colour of the file is 0.68 of white's light, which displays call 0.84; typed 0.5 is 0.214.
TEST_F(EditingTest, ColoursAreThoseOfDisplays) {
  open_with("Materials", scene("cornell"));
  click_with("ctrl", 480, 200);  // the back wall
  settle();
  const std::vector<int> rows = widgets_at(8 + 112, 8 + 140, 420);
  ASSERT_GE(rows.size(), 4u);
  type(8 + 120, rows[0], "0 period 5");
  settle();
  for (const nlohmann::json& material : saved()["materials"])
    if (material["name"] == "white") {
      EXPECT_NEAR(material["extras"]["pinocchio"]["phong"]["kd"][0].get<double>(), 0.2140, 1e-3);
    }
  key("ctrl+s");
  expect_clean_close();
}

// The list scrolls to a material that is picked, and a message names it.
TEST_F(EditingTest, APickedMaterialIsNamedAndScrolledTo) {
  open_with("Materials", scene("cornell"));
  const auto chosen_line = [this] {  // in the list: the accent's colour
    settle("list.png");
    for (int y = 8 + 24; y < 8 + 130; ++y) {
      const glm::u8vec3 c = picture("list.png").at(200, y);
      if (c.r > 200 && c.b < 120) return y;
    }
    return 0;
  };
  const int first = chosen_line();
  EXPECT_GT(first, 0);
  click_with("ctrl", 495, 440);  // glass, the last
  xdo(at(700, 500));
  EXPECT_TRUE(becomes([&] { return chosen_line() > first + 30; }));
  EXPECT_GT(different_in("200x30+8+540", "opened.png", "list.png"), 1000);  // the message
  expect_clean_close();
}

TEST_F(EditingTest, TheCameraIsTypedAndDragged) {
  open_with("Camera", scene("cornell"));
  const std::vector<int> rows = widgets_at(150, 30, 150);  // eye, target, field of view, lens, Top
  ASSERT_GE(rows.size(), 4u);
  type(120, rows[0], "0 period 5");
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  EXPECT_NEAR(vector_option("--eye")[0], 0.5, 1e-6);
  type(200, rows[1], "1 period 2 5");
  EXPECT_TRUE(becomes([&] { return std::abs(vector_option("--target")[1] - 1.25) < 1e-6; }));
  const double fov = std::stod(option(command_line(), "--fov"));
  drag_from(140, rows[2], 30);
  EXPECT_TRUE(becomes([&] { return std::stod(option(command_line(), "--fov")) > fov + 5.0; }));
  key("r");
  EXPECT_TRUE(picture_becomes("opened.png"));
  expect_clean_close();
}

// Parallel rays, with the target as large as before; then a height that is typed; Ctrl + Z takes both back.
TEST_F(EditingTest, TheProjectionIsChosen) {
  open_with("Camera", scene("cornell"));
  const std::vector<int> rows = widgets_at(150, 30, 200);  // eye, target, field of view, lens, projection
  ASSERT_GE(rows.size(), 5u);
  click(200, rows[4]);
  pause_ms(300);
  const std::vector<int> lines = runs(brightness(120, rows[4] + 14, 60, 90), rows[4] + 14, 120, 6, 20);
  ASSERT_EQ(lines.size(), 4u);  // perspective, orthographic, panorama, fisheye
  click(150, lines[1]);
  xdo(at(700, 500));
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  const std::string command = command_line();
  EXPECT_EQ(option(command, "--projection"), "orthographic");
  const double height = std::stod(option(command, "--height"));
  settle("orthographic.png");
  type(200, widgets_at(150, 30, 200)[2], "0 period 8");
  EXPECT_TRUE(picture_becomes_other("orthographic.png"));
  EXPECT_NEAR(std::stod(option(command_line(), "--height")), 0.8, 1e-6);
  EXPECT_GT(std::abs(height - 0.8), 0.1);
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(picture_becomes("orthographic.png"));
  key("ctrl+z");
  EXPECT_TRUE(picture_becomes("opened.png"));
  EXPECT_EQ(option(command_line(), "--projection"), "");
  expect_clean_close();
}

// A file whose z points up is read again and turned; the command draws it so.
TEST_F(EditingTest, TheUpAxisIsChosen) {
  std::ofstream(folder_ / "tower.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  open_with("Scene", "tower.obj", "--mode raster");
  const auto axis_row = [this] { return widgets_at(200, 30, 400).front(); };
  const auto axis_becomes = [this](const std::string& axis) {
    xdo(at(700, 500));
    return becomes([&] { return option(command_line(), "--up-axis") == axis; });
  };
  click(280, axis_row());  // z
  EXPECT_TRUE(axis_becomes("z"));
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  click(160, axis_row());  // y
  EXPECT_TRUE(axis_becomes(""));
  EXPECT_TRUE(picture_becomes("opened.png"));
  EXPECT_TRUE(becomes([this] {  // the panel, then the window
    key("Escape");
    return program_->wait(0.5) != -2;
  }));
  EXPECT_EQ(program_->wait(), 0) << errors();  // it has said that a studio lights the scene
}

// An environment's rows in the panel Lights, below those of a light and the kinds of lights.
TEST_F(EditingTest, TheEnvironmentIsTurnedAndMadeStronger) {
  std::ofstream(folder_ / "sky.hdr", std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n"
                                                       << std::string(32, '\x80');
  open_with("Lights", scene("two-lights"), "--environment sky.hdr --mode raster --eye 0,2,9 --target 0,3,0");
  const std::size_t of_lights = 9;  // position, colour, intensity, radius of two lights, kinds
  const std::vector<int> rows = widgets_at(121, 30, 590);
  ASSERT_GE(rows.size(), of_lights + 2);
  click(180, rows[of_lights]);
  xdo(at(700, 500));
  EXPECT_TRUE(becomes([this] { return !option(command_line(), "--environment-rotation").empty(); }));
  click(160, rows[of_lights + 1]);
  xdo(at(700, 500));
  EXPECT_TRUE(becomes([this] { return !option(command_line(), "--environment-strength").empty(); }));
  expect_clean_close();
}

// What is behind the scene: the environment, blurred; nothing. Ctrl + Z takes either back.
TEST_F(EditingTest, TheBackgroundIsBlurredAndHidden) {
  std::ofstream sky(folder_ / "sky.hdr", std::ios::binary);
  sky << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
  for (int i = 0; i < 32 * 64; ++i) sky << (i % 8 < 4 ? "\x20\x40\x7f\x80" : "\x7f\x40\x20\x80");
  sky.close();
  std::ofstream(folder_ / "triangle.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
  open_with("Lights", "triangle.obj", "--environment sky.hdr --mode raster --eye 0,0,6 --target 0,0,0");
  // Kinds of lights, turn, strength, kinds of background, blur.
  const std::vector<int> rows = widgets_at(170, 30, 560);
  ASSERT_EQ(rows.size(), 5u);
  const std::string behind = "300x200+450+40";
  const auto colors = [&] { return count_colors(crop(picture("still"), behind)); };
  click(150, rows[4]);
  xdo(at(700, 500));
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  settle("blurred.png");
  EXPECT_FALSE(option(command_line(), "--background-blur").empty());
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(picture_becomes("opened.png"));
  click(150, rows[3]);
  pause_ms(300);
  const std::vector<int> lines = runs(brightness(120, rows[3] + 14, 60, 90), rows[3] + 14, 120, 6, 20);
  ASSERT_GE(lines.size(), 4u);  // and what is below the list
  click(150, lines[2]);         // transparent: nothing to blur
  xdo(at(700, 500));
  settle();
  EXPECT_EQ(option(command_line(), "--background"), "transparent");
  EXPECT_EQ(colors(), 2u);  // chequers
  EXPECT_EQ(widgets_at(170, 30, 560).size(), 4u);
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(picture_becomes("opened.png"));
  expect_clean_close();
}

// The file's variants of its materials; an environment that was opened stays.
TEST_F(EditingTest, AVariantOfTheMaterialsIsChosen) {
  const std::vector<float> corners{-1.0f, -1.0f, 0.0f, 1.0f, -1.0f, 0.0f, 0.0f, 1.0f, 0.0f};
  std::ofstream(folder_ / "shoe.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(corners.data()),
             static_cast<std::streamsize>(corners.size() * sizeof(float)));
  const auto material = [](const char* name, float red, float blue) {
    return nlohmann::json{
        {"name", name},
        {"pbrMetallicRoughness", {{"baseColorFactor", {red, 0.0f, blue, 1.0f}}, {"metallicFactor", 0.0f}}}};
  };
  const nlohmann::json mappings = {{{"material", 1}, {"variants", {0}}},
                                   {{"material", 0}, {"variants", {1}}}};
  std::ofstream(folder_ / "shoe.gltf") << nlohmann::json{
      {"asset", {{"version", "2.0"}}},
      {"extensionsUsed", {"KHR_materials_variants"}},
      {"extensions",
       {{"KHR_materials_variants", {{"variants", {{{"name", "sea"}}, {{"name", "sun set"}}}}}}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes",
       {{{"primitives",
          {{{"attributes", {{"POSITION", 0}}},
            {"material", 0},
            {"extensions", {{"KHR_materials_variants", {{"mappings", mappings}}}}}}}}}}},
      {"materials", {material("red", 1.0f, 0.0f), material("blue", 0.0f, 1.0f)}},
      {"buffers", {{{"uri", "shoe.bin"}, {"byteLength", 36}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
      {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}}};
  open_with("Materials", "shoe.gltf", "--mode raster --light 0,0,5 --eye 0,0,4 --target 0,0,0");
  const auto color = [this] {
    settle();
    return glm::ivec3(picture("still").at(400, 300));
  };
  EXPECT_GT(color().r, color().b + 60);
  const int row = widgets_at(200, 30, 100).at(0);
  const auto choose = [&](std::size_t line) {
    click(200, row);
    pause_ms(300);
    const std::vector<int> lines = runs(brightness(120, row + 14, 60, 90), row + 14, 120, 6, 20);
    ASSERT_EQ(lines.size(), 3u);  // the usual one, and two
    click(150, lines[line]);
    xdo(at(700, 500));
  };
  const auto is_chosen = [&](const std::string& name) {
    return becomes([&] { return option(command_line(), "--variant") == name; });
  };
  ASSERT_NO_FATAL_FAILURE(choose(1));
  EXPECT_TRUE(is_chosen("sea"));
  EXPECT_GT(color().b, color().r + 60);
  EXPECT_EQ(option(command_line(), "--eye"), "0,0,4");  // the camera stays
  ASSERT_NO_FATAL_FAILURE(choose(2));
  EXPECT_TRUE(is_chosen("'sun"));  // of a name with a blank
  EXPECT_GT(color().r, color().b + 60);
  ASSERT_NO_FATAL_FAILURE(choose(0));
  EXPECT_TRUE(is_chosen(""));
  expect_clean_close();
}

// A scene that is as in its file is named in the command; an edited one is saved for it, which is said.
TEST_F(EditingTest, PSaysWhichSceneItWrites) {
  open_with("Scene", scene("cornell"));
  pause_ms(7000);  // what P said is gone by itself
  settle("quiet.png");
  const std::string messages = "560x60+0+510";
  EXPECT_NE(command_line().find("scenes/cornell"), std::string::npos);
  EXPECT_EQ(lines_of("the scene as it is shown is in"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cornell-001.gltf"));
  click(40, widgets_at(75, 240, 460)[1]);  // hides a part
  xdo(at(700, 500));
  EXPECT_NE(command_line().find("render cornell-001.gltf"), std::string::npos);
  EXPECT_EQ(lines_of("the scene as it is shown is in " + (folder_ / "cornell-001.gltf").string()), 1);
  settle("said.png");
  EXPECT_GT(different_in(messages, "quiet.png", "said.png"), 500);
  expect_clean_close();
}

// A light's name beside its mark does not touch the edge of its box.
TEST_F(EditingTest, AMarksLabelHasRoomAroundIt) {
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

// One part alone, then all again; the command draws what is shown.
TEST_F(EditingTest, PartsAreHiddenAndShownAlone) {
  open_with("Scene", scene("cornell"));
  const std::vector<int> rows = widgets_at(75, 240, 460);  // "Show all", then "only" of each part
  ASSERT_GE(rows.size(), 4u);
  click(75, rows[1]);  // the white walls
  xdo(at(700, 500));
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  settle("alone.png");
  const std::array<double, 3> wall = mean_of(crop(picture("alone.png"), "60x60+730+200"));
  EXPECT_LT(wall[1], 0.02);  // the green one is away
  const std::string command = command_line();
  EXPECT_NE(command.find("render cornell-001.gltf"), std::string::npos) << command;
  EXPECT_FALSE(saved().is_discarded());
  click(75, rows[0]);
  xdo(at(700, 500));
  EXPECT_TRUE(picture_becomes("opened.png"));
  click(40, rows[1]);  // its tick
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  settle("hidden.png");
  pause_ms(500);
  key("ctrl+z");
  EXPECT_TRUE(picture_becomes("opened.png"));
  key("ctrl+y");
  EXPECT_TRUE(picture_becomes("hidden.png"));
  key("Right");  // hiding is no edit: nothing is asked
  EXPECT_TRUE(
      becomes([this] { return xdo("getwindowname " + window_).find("cornell.gltf") == std::string::npos; }));
  expect_clean_close();
}

// One animation moves a triangle to the right, the other one another triangle up: together, or one alone.
// Half speed takes twice the time.
TEST_F(EditingTest, AnAnimationIsChosenAndItsSpeed) {
  const std::vector<float> numbers{-0.3f, -0.3f, 0.0f, 0.3f, -0.3f, 0.0f, 0.0f, 0.3f, 0.0f, 0.0f, 1.0f, 0.0f,
                                   0.0f,  0.0f,  1.0f, 0.0f, 0.0f,  0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f};
  std::ofstream(folder_ / "two.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  const auto view = [](int begin, int length) {
    return nlohmann::json{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", length}};
  };
  const auto accessor = [](int of, int count, const char* type) {
    return nlohmann::json{{"bufferView", of}, {"componentType", 5126}, {"count", count}, {"type", type}};
  };
  const auto animation = [](const char* name, int output, int node) {
    return nlohmann::json{
        {"name", name},
        {"samplers", {{{"input", 1}, {"output", output}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}};
  };
  std::ofstream(folder_ / "two.gltf") << nlohmann::json{
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0, 1}}}}},
      {"nodes", {{{"mesh", 0}}, {{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"buffers", {{{"uri", "two.bin"}, {"byteLength", 92}}}},
      {"bufferViews", {view(0, 36), view(36, 8), view(44, 24), view(68, 24)}},
      {"accessors",
       {accessor(0, 3, "VEC3"), accessor(1, 2, "SCALAR"), accessor(2, 2, "VEC3"), accessor(3, 2, "VEC3")}},
      {"animations", {animation("right", 2, 0), animation("up", 3, 1)}}};
  open_as_is("two.gltf", "800x600", "--spp 1 --mode raster --light 0,0,5 --eye 0,0,4 --target 0,0,0");
  // Where triangles are: at rest, to the right and above, after ten frames of 24 a second.
  const auto is_lit = [this](int x, int y) { return glm::ivec3(picture("still").at(x, y)).g > 60; };
  const auto expect_at = [&](bool rest, bool right, bool above) {
    EXPECT_TRUE(becomes([&] {
      settle();
      return is_lit(400, 330) == rest && is_lit(490, 330) == right && is_lit(400, 190) == above;
    })) << rest
        << right << above;
  };
  const auto on = [this] { xdo("key --repeat 10 --delay 60 ctrl+Right"); };
  const auto choose = [&](int line_y) {
    settle();
    click(640, 556);  // the list of animations
    settle();
    click(620, line_y);
    xdo(at(700, 60));
  };
  on();
  expect_at(false, true, true);
  choose(512);                    // "right"
  expect_at(true, false, false);  // from its beginning
  on();
  expect_at(true, true, false);
  choose(530);  // "up"
  on();
  expect_at(true, false, true);
  EXPECT_EQ(option(command_line(), "--animation"), "up");
  // The speed's field: half as fast is typed.
  key("Home");
  click_with("ctrl", 540, 556);
  pause_ms(200);
  key("ctrl+a 0 period 1 Return");
  choose(494);  // all, from the beginning
  key("space");
  pause_ms(1500);
  key("space");
  settle();
  const std::string command = command_line();
  EXPECT_LT(std::stod(option(command, "--time")), 0.9) << command;
  EXPECT_GT(std::stod(option(command, "--time")), 0.02) << command;
  expect_clean_close();
}

// What F12 writes is the picture alone, with Shift the window.
TEST_F(EditingTest, AScreenshotHasNoPanels) {
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
TEST_F(EditingTest, FilesAreSavedToAFolder) {
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

TEST_F(EditingTest, EdgesOfTrianglesAreShown) {
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
TEST_F(EditingTest, EnlargementEnds) {
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

TEST_F(EditingTest, SettingsAreSearched) {
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
TEST_F(EditingTest, ARefusedFileIsOpenedAnyway) {
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
TEST_F(EditingTest, EnlargedPixelsShowTheirLight) {
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

class PlacesTest : public WindowTest {
 protected:
  struct Box {
    int x = 0, y = 0, width = 0, height = 0;
  };
  // As the window has left them.
  [[nodiscard]] std::map<std::string, Box> boxes() const {
    const std::string layout =
        nlohmann::json::parse(text_of(folder_ / "config/pinocchio/window.json"))["layout"];
    std::map<std::string, Box> all;
    for (const char* panel : {"Drawing", "Camera", "Lights", "Materials"}) {
      const std::size_t begin = layout.find("[Window][" + std::string(panel) + "]");
      if (begin == std::string::npos) continue;
      Box& box = all[panel];
      std::sscanf(layout.c_str() + layout.find("Pos=", begin), "Pos=%d,%d", &box.x, &box.y);
      std::sscanf(layout.c_str() + layout.find("Size=", begin), "Size=%d,%d", &box.width, &box.height);
    }
    return all;
  }
};

TEST_F(PlacesTest, PanelsDoNotCoverEachOther) {
  open_as_is(scene("cornell"), "1200x740", "--spp 1");
  for (const char* panel : {"F3", "F5", "F6", "F7"}) {
    key(panel);
    settle();
  }
  expect_clean_close();
  const std::map<std::string, Box> all = boxes();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [a_name, a] : all)
    for (const auto& [b_name, b] : all)
      if (a_name < b_name) {
        EXPECT_FALSE(a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
                     b.y < a.y + a.height)
            << a_name << " and " << b_name;
      }
}

// Drawing has more rows with each channel, and stays whole and in the window.
TEST_F(PlacesTest, DrawingGrowsWithItsChannel) {
  open_as_is(scene("cornell"), "800x600", "--spp 1");
  key("F3");
  settle("drawing.png");
  const auto rows = [this] { return widgets_at(640, 30, 560).size(); };
  const std::size_t at_first = rows();
  for (int channel = 0; channel < 6; ++channel) {  // ids to depth, whose range can be set
    key("v");
    xdo(at(100, 500));
    settle("channel.png");
    EXPECT_GE(rows(), at_first) << channel;  // the last row, too
    EXPECT_EQ(different_in("300x20+470+8", "drawing.png", "channel.png", 40), 0) << channel;  // the title
  }
  expect_clean_close();
  const Box box = boxes().at("Drawing");
  EXPECT_LE(box.y + box.height, 580);
}

// At its edge, also one that was closed meanwhile.
TEST_F(PlacesTest, PanelsStayAtTheEdgesOfALargerWindow) {
  open_as_is(scene("cornell"), "800x600", "--spp 1");
  key("F3 F7");
  settle();
  key("F7");
  xdo("windowsize --sync " + window_ + " 1200 740");
  settle();
  key("F7");
  settle();
  expect_clean_close();
  const std::map<std::string, Box> all = boxes();
  EXPECT_EQ(all.at("Drawing").x + all.at("Drawing").width, 1200 - 8);
  const Box& materials = all.at("Materials");
  EXPECT_TRUE(materials.x == 8 || materials.x + materials.width == 1200 - 8) << materials.x;
}

}  // namespace
}  // namespace pinocchio
