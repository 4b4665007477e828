// What data sets need, from the command line: layers by name, cameras, STL, raw frames.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "pinocchio/exr.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class DataSetsTest : public ProgramTest {
 protected:
  [[nodiscard]] ExrFile exr(const std::string& name) const {
    Expected<ExrFile> file = read_exr(folder_ / name);
    EXPECT_TRUE(file) << file.error().message();
    return file ? std::move(*file) : ExrFile{};
  }
  void expect_done(const std::string& arguments) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  [[nodiscard]] std::string text_of(const ExrFile& file, const std::string& attribute) const {
    const auto found = file.attributes.find(attribute);
    return found == file.attributes.end() ? "" : std::get<std::string>(found->second);
  }
};

const std::string kSmall = "--size 80x60 --quiet --mode raytrace ";

TEST_F(DataSetsTest, LayersAreWrittenWhereTheyAreNamed) {
  expect_done("render" + scene("windmill") + kSmall + "-o usual.exr");
  const ExrFile usual = exr("usual.exr");
  for (const char* name : {"id.node", "id.material", "id.primitive", "motion.X"})
    EXPECT_EQ(usual.find(name), nullptr) << name;
  EXPECT_EQ(text_of(usual, "pinocchio.nodes"), "");
  expect_done("render" + scene("windmill") + kSmall +
              "--frames 24-25 --aov all,id.node,id.material,id.primitive,motion -o f##.exr");
  const ExrFile file = exr("f24.exr");
  EXPECT_EQ(file.channels.size(), usual.channels.size() + 5);
  const nlohmann::json nodes = nlohmann::json::parse(text_of(file, "pinocchio.nodes")),
                       materials = nlohmann::json::parse(text_of(file, "pinocchio.materials"));
  const auto& ids = file.find("id.triangle")->uints;
  std::size_t moving = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool hit = ids[i] != 0xffffffffu;
    EXPECT_EQ(file.find("id.node")->uints[i] != 0xffffffffu, hit);
    if (!hit) continue;
    EXPECT_LT(file.find("id.node")->uints[i], nodes.size());
    EXPECT_LT(file.find("id.material")->uints[i], materials.size());
    const float x = file.find("motion.X")->values[i], y = file.find("motion.Y")->values[i];
    EXPECT_TRUE(std::isfinite(x) && std::isfinite(y));
    moving += std::hypot(x, y) > 0.1f ? 1 : 0;
  }
  EXPECT_GT(moving, 20u);
  EXPECT_LT(moving, ids.size() / 2);
  // The former frame's motion of frame 25 leads back to frame 24.
  expect_done("render" + scene("windmill") + kSmall +
              "--frames 25-25 --aov motion,id --motion-to former -o back.exr");
  const ExrFile back = exr("back.exr");
  int found = 0;
  for (int y = 2; y < 58; ++y)
    for (int x = 2; x < 78; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * 80 + static_cast<std::size_t>(x);
      const float move_x = file.find("motion.X")->values[i], move_y = file.find("motion.Y")->values[i];
      if (ids[i] == 0xffffffffu || std::hypot(move_x, move_y) < 0.3f) continue;
      const int to_x = x + static_cast<int>(std::lround(move_x)),
                to_y = y + static_cast<int>(std::lround(move_y));
      if (to_x < 0 || to_y < 0 || to_x >= 80 || to_y >= 60) continue;
      const std::size_t j = static_cast<std::size_t>(to_y) * 80 + static_cast<std::size_t>(to_x);
      if (back.find("id.triangle")->uints[j] != ids[i]) continue;
      EXPECT_NEAR(back.find("motion.X")->values[j], -move_x, 0.1f);
      EXPECT_NEAR(back.find("motion.Y")->values[j], -move_y, 0.1f);
      ++found;
    }
  EXPECT_GT(found, 40);
}

TEST_F(DataSetsTest, MotionOfATurningCameraAndOfNothing) {
  expect_done("render" + scene("two-lights") + kSmall +
              "--turntable 36 --frames 3-3 --aov motion -o turn.exr");
  expect_done("render" + scene("two-lights") + kSmall + "--aov motion -o still.exr");
  float most = 0.0f;
  const auto turned = exr("turn.exr"), still = exr("still.exr");
  for (const float x : turned.find("motion.X")->values) most = std::max(most, std::abs(x));
  EXPECT_GT(most, 1.0f);
  for (const float x : still.find("motion.X")->values) EXPECT_EQ(x, 0.0f);
}

TEST_F(DataSetsTest, CamerasThatOpenGlCannotDrawGoToTheCpu) {
  const std::string away = " --backend egl --device 99 ";  // there is none
  for (const char* camera : {"panorama", "fisheye --fov 220"}) {
    expect_done("render" + scene("two-lights") + "--size 64x32 --quiet" + away + "--projection " + camera +
                " -o c.exr");
    const ExrFile file = exr("c.exr");
    EXPECT_EQ(text_of(file, "pinocchio.projection"),
              std::string(camera).substr(0, std::string(camera).find(' ')));
    EXPECT_FALSE(file.attributes.contains("worldToNDC"));
    std::size_t seen = 0;
    for (const float a : file.find("A")->values) seen += a > 0.0f ? 1 : 0;
    EXPECT_GT(seen, 50u);
    const CommandResult plan = run("info" + scene("two-lights") + "--plan --projection " + camera);
    EXPECT_EQ(plan.exit_code, 0);
    EXPECT_NE(plan.out.find("nothing that OpenGL can draw: rays are the CPU's"), std::string::npos)
        << plan.out;
    EXPECT_NE(plan.out.find("\"visibility\":\"cpu\""), std::string::npos) << plan.out;
  }
  EXPECT_EQ(
      run("render" + scene("two-lights") + kSmall + "--projection fisheye --fov 361 -o x.exr").exit_code, 2);
  EXPECT_EQ(run("render" + scene("two-lights") + kSmall + "--fov 181 -o x.exr").exit_code, 2);
  EXPECT_EQ(run("render" + scene("two-lights") + kSmall + "--projection wide -o x.exr").exit_code, 2);
  EXPECT_EQ(run("render" + scene("two-lights") + kSmall + "--height 0 -o x.exr").exit_code, 2);
}

// At the target, both show the same size.
TEST_F(DataSetsTest, AnOrthographicPictureShowsTheTargetAsThePerspectiveOne) {
  const std::string at = "--eye 0,1,6 --target 0,1,0 --fov 40 ";
  expect_done("render" + scene("two-lights") + kSmall + at + "--projection orthographic -o o.exr");
  const ExrFile file = exr("o.exr");
  const auto matrix = std::get<glm::mat4>(file.attributes.at("worldToNDC"));
  const glm::vec4 top = matrix * glm::vec4(0, 1 + 6 * std::tan(glm::radians(20.0f)), 0, 1),
                  far_top = matrix * glm::vec4(0, 1 + 6 * std::tan(glm::radians(20.0f)), -9, 1);
  EXPECT_NEAR(top.y / top.w, 0.0f, 1e-5f);
  EXPECT_NEAR(far_top.y / far_top.w, 0.0f, 1e-5f);
}

TEST_F(DataSetsTest, FramesGoToStandardOutput) {
  const CommandResult raw = run("render" + scene("two-lights") +
                                "--size 20x10 --mode raytrace --turntable 3 --raw - | tee frames | wc -c");
  EXPECT_EQ(raw.exit_code, 0) << raw.err;
  EXPECT_EQ(std::filesystem::file_size(folder_ / "frames"), 3u * 20 * 10 * 3);
  expect_done("render" + scene("two-lights") +
              "--size 20x10 --quiet --mode raytrace --turntable 3 --preview p#.png -o p#.exr");
  std::ifstream in(folder_ / "frames", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(bytes.substr(0, 600), bytes.substr(600, 600));
  EXPECT_NE(bytes.substr(0, 600), std::string(600, '\0'));
  // A reader that ends early is an error, not a signal.
  const CommandResult early =
      run("render" + scene("two-lights") +
          "--size 400x300 --mode raytrace --turntable 30 --raw - 2>early | head -c 1; "
          "cat early");
  EXPECT_NE(early.out.find("standard output cannot be written"), std::string::npos) << early.out;
  EXPECT_EQ(std::count(early.out.begin(), early.out.end(), '\n'), 1) << early.out;
  EXPECT_EQ(run("render" + scene("two-lights") + "--raw - --skip-existing -o x.exr").exit_code, 2);
}

TEST_F(DataSetsTest, OneOfAFilesAnimationsPlays) {
  expect_done("render" + scene("windmill") + kSmall + "--animation 0 --time 1 -o one.exr");
  const CommandResult none = run("render" + scene("windmill") + kSmall + "--animation fly -o x.exr");
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_NE(none.err.find("has no animation 'fly'; choose from 0"), std::string::npos) << none.err;
}

// In every mode the same ids: those of the node, of the material and of the triangle within the node.
TEST_F(DataSetsTest, PointsAndLinesAreDrawnInEveryMode) {
  write("wire.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\np 1\nl 2 3\n");
  const CommandResult refused = run("render wire.obj -o x.exr");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.err.find("draw them with --point-size D and --line-width D"), std::string::npos)
      << refused.err;
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_EQ(run("render wire.obj --point-size 0 -o x.exr").exit_code, 2);
  std::vector<std::uint32_t> first;
  for (const char* mode : {"raytrace", "hybrid", "raster"}) {
    expect_done(
        std::string("render wire.obj --size 80x60 --quiet --point-size 0.4 --line-width 0.2 --eye 0.5,0.5,4 "
                    "--target 0.5,0.5,0 --aov all,id.node,id.material,id.primitive -o wire.exr --mode ") +
        mode);
    const auto file = exr("wire.exr");
    const std::vector<std::uint32_t>& ids = file.find("id.triangle")->uints;
    EXPECT_GT(std::ranges::count_if(ids, [](std::uint32_t id) { return id < 1280; }), 50) << mode;
    EXPECT_GT(std::ranges::count_if(ids, [](std::uint32_t id) { return id >= 1280 && id != 0xffffffff; }), 50)
        << mode;
    EXPECT_EQ(file.find("id.primitive")->uints, ids) << mode;  // the file has no nodes
    if (first.empty()) first = ids;
    std::size_t others = 0;  // edges of triangles may fall to either neighbour
    for (std::size_t i = 0; i < ids.size(); ++i) others += ids[i] != first[i] ? 1 : 0;
    EXPECT_LE(others, ids.size() / 200) << mode;
  }
  const CommandResult info = run("info wire.obj --point-size 0.4");
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_NE(info.out.find("lines are left out"), std::string::npos) << info.out;
}

TEST_F(DataSetsTest, StlIsDrawnWithTheAxisThatIsUp) {
  write("part.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 "
        "1\nendloop\nendfacet\n");
  const std::string rest = " --size 40x40 --quiet --mode raytrace --eye 0.3,0.3,5 --target 0.3,0.3,0 ";
  expect_done("render part.stl" + rest + "-o lies.exr");
  expect_done("render part.stl" + rest + "--up-axis z -o stands.exr");
  const auto seen = [&](const char* name) {
    std::size_t count = 0;
    const auto file = exr(name);
    for (const std::uint32_t id : file.find("id.triangle")->uints) count += id == 0 ? 1 : 0;
    return count;
  };
  EXPECT_GT(seen("stands.exr"), 20u);
  EXPECT_LT(seen("lies.exr"), seen("stands.exr"));
}

}  // namespace
}  // namespace pinocchio
