// What panels change in the scene: lights, materials, cameras, parts, animations.
#include "tests/view/editing.h"

namespace pinocchio {
namespace {

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

// However fast it follows: a key after Return is the window's again, one after the click the field's.
TEST_F(EditingTest, KeysAreTheFieldsWhileItIsOpenAndNoLonger) {
  open_with("Camera", scene("cornell"));
  const std::vector<int> rows = widgets_at(150, 30, 150);
  ASSERT_GE(rows.size(), 4u);
  for (const std::string digits : {"3", "5", "7"}) {
    const long printed = lines_of("pinocchio render");
    xdo(at(120, rows[0]) + "sleep 0.1 keydown ctrl click 1 keyup ctrl");
    xdo("key --delay 0 0 period " + digits + " Return p");
    EXPECT_TRUE(becomes([&] { return lines_of("pinocchio render") > printed; })) << digits;
    EXPECT_NEAR(vector_option("--eye")[0], std::stod("0." + digits), 1e-6);
  }
  expect_clean_close();
}

// From typed number to typed number, however fast.
TEST_F(EditingTest, TabLeadsToTheNextField) {
  open_with("Camera", scene("cornell"));
  const std::vector<int> rows = widgets_at(150, 30, 150);
  ASSERT_GE(rows.size(), 4u);
  xdo(at(120, rows[0]) + "sleep 0.1 keydown ctrl click 1 keyup ctrl");
  xdo("key --delay 0 0 period 5 Tab 1 period 2 5 Tab 2 period 7 5 Return");
  EXPECT_TRUE(picture_becomes_other("opened.png"));
  EXPECT_EQ(option(command_line(), "--eye"), "0.5,1.25,2.75");
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
    std::vector<int> lines;
    ASSERT_TRUE(becomes([&] {
      lines = runs(brightness(120, row + 14, 60, 90), row + 14, 120, 6, 20);
      return lines.size() == 3;  // the usual one, and two
    }));
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
  pause_ms(500);       // changes within 0.4 s are one step of the history
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

}  // namespace
}  // namespace pinocchio
