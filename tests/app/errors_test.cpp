// Bad input: one clear line, the right exit code, nothing half-written.
#include <algorithm>

#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class ErrorsTest : public ProgramTest {
 protected:
  // Runs, and expects this exit code, one line on stderr that holds `words`, and no file.
  void expect_error(const std::string& arguments, int exit_code, const std::string& words) {
    const std::size_t before = files();
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(files(), before) << arguments;
  }
};

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(ErrorsTest, Scenes) {
  write("empty.obj", "");
  write("range.obj", std::string(kTriangle) + "f 1 2 7\n");
  write("word.obj", "v 0 0 0\nv one 0 0\nv 0 1 0\nf 1 2 3\n");
  write("none.obj", kTriangle);
  write("text.gltf", "hello");
  write("scene.xyz", "x");
  expect_error("render missing.obj -o x.exr", 4, "missing.obj: there is no such file");
  expect_error("render empty.obj -o x.exr", 4, "empty.obj: is empty");
  expect_error("render range.obj -o x.exr", 4, "range.obj:4: a face names vertex 7");
  expect_error("render word.obj -o x.exr", 4, "word.obj:2: 'one'");
  expect_error("render none.obj -o x.exr", 4, "none.obj: holds no triangles");
  expect_error("render text.gltf -o x.exr", 4, "text.gltf");
  expect_error("render scene.xyz -o x.exr", 4, "scene.xyz");
  expect_error("info missing.glb", 4, "missing.glb");
}

TEST_F(ErrorsTest, CameraPaths) {
  const std::string render =
      "render" + scene("cornell") + "--size 8x8 --mode raytrace -o x#.exr --path p.json";
  const auto with = [&](const std::string& key, const std::string& words) {
    write("p.json",
          "{\"keyframes\": [{\"frame\": 0, \"eye\": [0, 1, 3], \"target\": [0, 1, 0]}, {" + key + "}]}");
    expect_error(render, 2, words);
  };
  with(R"("frame": 3000000000, "eye": [0, 1, 2], "target": [0, 1, 0])",
       "key frame 1: frame is a whole number");
  with(R"("frame": 1, "eye": [0, 3.5e38, 2], "target": [0, 1, 0])", "key frame 1: eye is [x, y, z]");
  with(R"("frame": 1, "eye": [0, 1e999, 2], "target": [0, 1, 0])", "too large");
  with(R"("frame": 1, "eye": [0, 1, 0], "target": [0, 1, 0])", "same point");
  with(R"("frame": 1, "eye": [0, 1, 2], "target": [0, 1, 0], "fov": -20)", "0 and 180");
  with(R"("frame": 1, "eye": [0, 1, 2], "traget": [0, 1, 0])", "there is no 'traget'");
  with(R"("frame": 2, "eye": [0, 1, -3], "target": [0, 1, 0], "up": [0, 0, 0])",
       "the camera's up is not a direction");
  with(R"("frame": 2, "eye": [0, 1, -3], "target": [0, 1, 0])",
       "in frame 1 the camera's eye is at its target");
  write("plan.json", R"({"depth": 1e999})");
  expect_error("render" + scene("cornell") + "--plan plan.json -o x.exr", 2, "too large");
}

TEST_F(ErrorsTest, NineCastingLightsInAMaskOfEight) {
  std::string lights;
  for (int i = 0; i < 8; ++i) lights += " --light 0,1,0";
  expect_error(
      "render" + scene("cornell") + lights + " --mask-bits 8 --reflection none --composite gpu -o x.exr", 4,
      "mask_bits 8 cannot hold the scene's 9 casting lights");
}

TEST_F(ErrorsTest, Usage) {
  const std::string render = "render" + scene("cornell");
  expect_error("", 2, "--help");
  expect_error("dance", 2, "dance");
  expect_error(render + "--frobnicate -o x.exr", 2, "--frobnicate");
  expect_error(render + "--size 0x600 -o x.exr", 2, "--size");
  expect_error(render + "--size 0 -o x.exr", 2, "--size");
  expect_error(render + "--size 100000x100000 -o x.exr", 2, "16384");
  expect_error(render + "--size -5x7 -o x.exr", 2, "--size");
  expect_error(render + "--mode sideways -o x.exr", 2, "hybrid, raytrace, raster or auto");
  expect_error(render + "--eye 1,2 -o x.exr", 2, "--eye");
  expect_error(render + "--eye 1,2,nan -o x.exr", 2, "--eye");
  expect_error(render + "--fov 180 -o x.exr", 2, "--fov");
  for (const char* time : {"0ms", "-1s", "0x10ms", "16sm", "ms", "nan", "1e400"})
    expect_error(render + "--budget=" + time + " -o x.exr", 2, "is not a time such as 16ms");
  for (const char* limit : {"flip", "flip=", "flip=-1", "flip=nan", "psnr=3", "=1"})
    expect_error(render + "--max-error " + limit + " -o x.exr", 2, "is not METRIC=VALUE");
  expect_error(render + "--light 1,2,3,bright -o x.exr", 2, "--light");
  expect_error(render + "--spp 0 -o x.exr", 2, "--spp");
  expect_error(render + "--threads -1 -o x.exr", 2, "--threads");
  expect_error(render + "--isa mmx -o x.exr", 2, "--isa");
  expect_error(render + "--triangle-test none -o x.exr", 2, "--triangle-test");
  expect_error(render + "--offset 0.1 -o x.exr", 2, "--offset");
  expect_error(render + "--camera nobody -o x.exr", 2, "only these cameras: front");
  expect_error(render + "--crop 900,900,950,950 -o x.exr", 2, "--crop");
  expect_error(render + "--frames 5-2 -o x.exr", 2, "--frames");
  expect_error(render + "--turntable 4 -o x.exr", 2, "####");
  expect_error(render + "--exchange reproject --design 2 -o x.exr", 2, "--design 1");
  expect_error(render + "-o x.jpg", 2, "does not end in .exr");
  expect_error(render + "--aov depth -o x.exr", 2, "depth");
  expect_error(render, 2, "nothing to write");
  expect_error("render -o x.exr", 2, "SCENE");
  expect_error("generate nothing", 2, "two-lights");
  expect_error("generate cornell -o x.stl", 2, "choose .gltf, .glb or .obj");
  expect_error("generate cornell --triangles 5000 -o x.gltf", 2,
               "the scene 'cornell' has a fixed number of triangles; leave out --triangles");
  expect_error(render + "--projection fisheye --mask-scale 2 -o x.exr", 2, "the CPU alone draws a panorama");
  expect_error("measure" + scene("cornell") + "--compare --projection panorama", 2, "cannot draw a panorama");
}

TEST_F(ErrorsTest, Outputs) {
  const std::string render = "render" + scene("cornell") + "--size 32x24 ";
  expect_error(render + "-o nowhere/x.exr", 1,
               "nowhere/x.exr: cannot be written: there is no folder nowhere");
  expect_error(render + "-o /proc/x.exr", 1, "/proc/x.exr: cannot be written");
  expect_error(render + "-o x.exr --preview nowhere/x.png", 1, "nowhere/x.png");
  expect_error(render + "-o x.exr --stats-json nowhere/x.json", 1, "nowhere/x.json");
  expect_error("generate cornell -o nowhere/x.gltf", 1, "nowhere/x.");
}

TEST_F(ErrorsTest, Contexts) {
  const std::string render = "render" + scene("cornell") + "--size 32x24 -o x.exr ";
  expect_error(render + "--backend egl --device 99", 3, "--device 99");
  expect_error(render + "--backend glut", 2, "--backend");
  expect_error(render + "--device zwei", 2, "--device");
  EXPECT_EQ(run(render, "PINOCCHIO_BACKEND=egl PINOCCHIO_DEVICE=99").exit_code, 3);
}

}  // namespace
}  // namespace pinocchio
