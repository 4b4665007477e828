#include <nlohmann/json.hpp>

#include "pinocchio/exr.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class RenderTest : public ProgramTest {
 protected:
  [[nodiscard]] ExrFile exr(const std::string& name) const {
    Expected<ExrFile> file = read_exr(folder_ / name);
    EXPECT_TRUE(file) << file.error().message();
    return file ? std::move(*file) : ExrFile{};
  }
  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return nlohmann::json::parse(in, nullptr, false);
  }
  void expect_done(const std::string& arguments) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
};

const std::string kSmallPicture = "--size 80x60 --quiet ";

bool same_pixels(const ExrFile& a, const ExrFile& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (std::size_t i = 0; i < a.channels.size(); ++i)
    if (a.channels[i].values != b.channels[i].values || a.channels[i].uints != b.channels[i].uints)
      return false;
  return true;
}

// A triangle in a box of six colours, seen from behind: the box alone.
TEST_F(RenderTest, AFilesEnvironmentIsSeenUnlessAnotherIsGiven) {
  std::string sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) sky += "\x80\x40\x20\x81";  // 1, 1/2, 1/4
  write("sky.hdr", sky);
  const std::string away = "render '" PINOCCHIO_SOURCE_DIR
                           "/tests/fuzz/corpus/gltf/environment.gltf' --size 8x6 --quiet --mode raytrace "
                           "--eye 9,0,0 --target 20,0,0 ";
  expect_done(away + "-o own.exr");
  expect_done(away + "-o precise.exr --precise");
  expect_done(away + "-o other.exr --environment sky.hdr");
  for (const auto& [channel, given] :
       {std::pair("R", 1.0f), std::pair("G", 0.5f), std::pair("B", 0.25f), std::pair("A", 0.0f)}) {
    const std::vector<float> own = exr("own.exr").find(channel)->values,
                             other = exr("other.exr").find(channel)->values;
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(other[i], given);
    EXPECT_TRUE(given == 0.0f || (own[0] > 0.0f && own[0] != given)) << own[0];
    const std::vector<float> precise = exr("precise.exr").find(channel)->values;
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(own[i], precise[i], 0.002f * precise[i]);
  }
}

TEST_F(RenderTest, WritesEveryChannelAndTheFigures) {
  expect_done("render" + scene("two-lights") + kSmallPicture +
              "-o x.exr --preview x.png --stats-json x.json");
  const ExrFile file = exr("x.exr");
  for (const char* name :
       {"R", "G", "B", "A", "Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "Albedo.R", "Albedo.G", "Albedo.B",
        "id.triangle", "shadow.mask", "reflection.R", "reflection.G", "reflection.B"})
    EXPECT_NE(file.find(name), nullptr) << name;
  for (const char* name : {"worldToCamera", "worldToNDC", "pinocchio.version", "pinocchio.plan",
                           "pinocchio.lights", "renderTimeSeconds"})
    EXPECT_EQ(file.attributes.count(name), 1u) << name;
  EXPECT_TRUE(exists("x.png"));

  const nlohmann::json figures = json("x.json");
  const nlohmann::json& buffers = figures["bytes"]["buffers"];
  EXPECT_EQ(buffers["ids"].get<int>() + buffers["traced_ids"].get<int>(), 80 * 60 * 2);  // 16 bits
  EXPECT_EQ(buffers["mask"], 10 * 60);                                                   // one bit
  EXPECT_GT(buffers["reflection"], 0);
  EXPECT_LT(buffers["reflection"], 80 * 60 * 6);  // half RGB, where there is some
  EXPECT_EQ(figures["latency"]["frames"], 0);
  for (const char* stage : {"pose", "trees", "raster", "readback", "trace_shadow", "trace_reflection",
                            "upload", "composite", "present"})
    for (const char* p : {"p50", "p95", "p99"})
      EXPECT_TRUE(figures["stages"][stage]["ms"][p].is_number()) << stage;
  for (const char* kind : {"primary", "shadow", "reflection", "refraction"})
    EXPECT_TRUE(figures["rays"][kind].is_number());
  EXPECT_GT(figures["rays"]["shadow"], 0);
  EXPECT_GT(figures["fps"], 0.0);
  EXPECT_EQ(figures["plan"]["mask_bits"], 1);
  EXPECT_TRUE(figures["system"]["gl"]["kind"] == "software" || figures["system"]["gl"]["kind"] == "hardware");
}

TEST_F(RenderTest, DeterministicFilesAreEqualToTheByte) {
  for (const char* name : {"a.exr", "b.exr"})
    expect_done("render" + scene("cornell") + kSmallPicture + "--deterministic -o " + name);
  EXPECT_EQ(run_command("cd '" + folder_.string() + "' && cmp a.exr b.exr", folder_ / "scratch").exit_code,
            0);
}

TEST_F(RenderTest, ThreadsIsaAndExchangeDoNotChangeThePixels) {
  expect_done("render" + scene("two-lights") + kSmallPicture + "-o a.exr");
  const std::vector<std::string> all{"--threads 1", "--threads 4", "--isa scalar", four_lanes(),
                                     "--exchange pipelined"};
  for (const std::string& options : all) {
    expect_done("render" + scene("two-lights") + kSmallPicture + options + " -o b.exr");
    EXPECT_TRUE(same_pixels(exr("a.exr"), exr("b.exr"))) << options;
  }
  expect_done("render" + scene("two-lights") + kSmallPicture + "--backend osmesa -o b.exr");
  EXPECT_TRUE(same_pixels(exr("a.exr"), exr("b.exr"))) << "osmesa";
}

TEST_F(RenderTest, CropKeepsTheDisplayWindow) {
  expect_done("render" + scene("cornell") + kSmallPicture + "--crop 10,20,50,45 --mode raytrace -o x.exr");
  EXPECT_EQ(exr("x.exr").display_size, glm::ivec2(80, 60));
  EXPECT_EQ(exr("x.exr").data_window, (PixelBox{{10, 20}, {50, 45}}));
}

TEST_F(RenderTest, FramesAreNumbered) {
  expect_done("render" + scene("cornell") + kSmallPicture + "--turntable 4 --stats-json x.json -o f####.exr");
  for (const char* name : {"f0000.exr", "f0001.exr", "f0002.exr", "f0003.exr"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_FALSE(same_pixels(exr("f0000.exr"), exr("f0001.exr")));
  EXPECT_EQ(json("x.json")["latency"]["frames"], 2);  // over a range, pipelined
  expect_done("render" + scene("cornell") + kSmallPicture + "--turntable 4 --frames 1-3x2 -o g#.exr");
  EXPECT_TRUE(exists("g1.exr") && exists("g3.exr") && !exists("g0.exr") && !exists("g2.exr"));
  EXPECT_TRUE(same_pixels(exr("f0003.exr"), exr("g3.exr")));
}

TEST_F(RenderTest, CameraPath) {
  write("path.json", R"({"keyframes": [{"frame": 0, "eye": [0, 1, 3], "target": [0, 1, 0]},
                                       {"frame": 2, "eye": [0.4, 1, 3], "target": [0, 1, 0], "fov": 40}]})");
  expect_done("render" + scene("cornell") + kSmallPicture + "--path path.json -o p#.exr");
  EXPECT_TRUE(exists("p0.exr") && exists("p1.exr") && exists("p2.exr") && !exists("p3.exr"));
  expect_done("render" + scene("cornell") + kSmallPicture +
              "--eye 0.2,1,3 --target 0,1,0 --fov 44 -o direct.exr");
  expect_done("render" + scene("cornell") + kSmallPicture + "--eye 0,1,3 --target 0,1,0 -o first.exr");
  EXPECT_TRUE(same_pixels(exr("p0.exr"), exr("first.exr")));
}

// Frames are made as they are drawn: a path of two thousand million is begun at once, and takes no more
// memory.
TEST_F(RenderTest, APathMayBeOfAnyLength) {
  write("path.json", R"({"keyframes": [{"frame": 0, "eye": [0, 1, 3], "target": [0, 1, 0]},
                                       {"frame": 2000000000, "eye": [0.4, 1, 3], "target": [0, 1, 0]}]})");
  const std::string render =
      "render" + scene("cornell") + "--size 8x6 --mode raytrace --path path.json -o p#.exr ";
  expect_done(render + "--frames 1000000000-2000000000x500000000");
  EXPECT_TRUE(exists("p1000000000.exr") && exists("p1500000000.exr") && exists("p2000000000.exr"));
  expect_done("render" + scene("cornell") +
              "--size 8x6 --mode raytrace --eye 0.2,1,3 --target 0,1,0 -o middle.exr");
  EXPECT_TRUE(same_pixels(exr("p1000000000.exr"), exr("middle.exr")));
  const CommandResult all =
      run_command("cd '" + folder_.string() + "' && timeout -s INT 3 '" PINOCCHIO_PROGRAM "' " + render,
                  folder_ / "scratch");
  EXPECT_EQ(all.exit_code, 124) << all.err;  // its time was over
  EXPECT_TRUE(exists("p0.exr") && exists("p1.exr")) << all.err;
}

TEST_F(RenderTest, LightsAreAddedAndADefaultOneIsSaid) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const CommandResult result = run("render t.obj --size 80x60 --mode raytrace -o x.exr");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("no light"), std::string::npos);
  EXPECT_EQ(std::get<std::string>(exr("x.exr").attributes["pinocchio.lights"]).find("--light"),
            std::string::npos);
  expect_done("render t.obj " + kSmallPicture +
              "--mode raytrace --light 1,2,3,0.5,nocast --light 3,2,1 -o x.exr");
  const std::string lights = std::get<std::string>(exr("x.exr").attributes["pinocchio.lights"]);
  EXPECT_EQ(nlohmann::json::parse(lights).size(), 1u);  // the one that casts
}

TEST_F(RenderTest, ConfinedScenesNameFilesBelowTheirFolderOnly) {
  std::filesystem::create_directory(folder_ / "in");
  write("m.mtl", "newmtl m\nKd 1 0 0\n");
  write("in/t.obj", "mtllib ../m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_done("render in/t.obj " + kSmallPicture + "--mode raytrace --light 1,2,3 -o x.exr");
  for (const char* command : {"render in/t.obj --confine --mode raytrace -o y.exr", "info in/t.obj --confine",
                              "measure in/t.obj --confine --mode raytrace"}) {
    const CommandResult result = run(command);
    EXPECT_EQ(result.exit_code, 4) << command;
    EXPECT_NE(result.err.find("m.mtl: lies outside the scene's folder"), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
  EXPECT_FALSE(exists("y.exr"));
}

TEST_F(RenderTest, GeneratesScenesThatItCanDraw) {
  for (const char* name : {"spd:balls", "forest"})
    for (const char* file : {"s.gltf", "s.glb", "s.obj"}) {
      expect_done(std::string("generate ") + name + " --triangles 5000 -o " + file);
      expect_done("render " + std::string(file) + " " + kSmallPicture + "--light 2,3,4 -o x.exr");
    }
}

TEST_F(RenderTest, CompressionIsOfTheFileAlone) {
  expect_done("render" + scene("cornell") + kSmallPicture + "--mode raytrace -o zip.exr");
  const auto bytes = [&](const std::string& name) { return std::filesystem::file_size(folder_ / name); };
  for (const std::string name : {"none", "zips", "piz", "rle"}) {
    expect_done("render" + scene("cornell") + kSmallPicture + "--mode raytrace --compression " + name +
                " -o " + name + ".exr");
    EXPECT_TRUE(same_pixels(exr("zip.exr"), exr(name + ".exr"))) << name;
    EXPECT_GT(bytes("none.exr") + (name == "none" ? 1 : 0), bytes(name + ".exr")) << name;
  }
  EXPECT_LT(bytes("zip.exr"), bytes("rle.exr"));
  EXPECT_EQ(run("render" + scene("cornell") + kSmallPicture + "--compression dwaa -o x.exr").exit_code, 2);
}

// Where OpenGL is software; on hardware the two modes are one.
TEST_F(RenderTest, AutoNeedsNoSoftwareOpenGl) {
  const std::string draw = "render" + scene("two-lights") + "--size 80x60 --device software ";
  const std::string advice = "--mode auto would draw with the CPU alone";
  const CommandResult hybrid = run(draw + "-o h.exr");
  EXPECT_EQ(hybrid.exit_code, 0);
  EXPECT_NE(hybrid.err.find(advice), std::string::npos) << hybrid.err;
  EXPECT_EQ(std::ranges::count(hybrid.err, '\n'), 1) << hybrid.err;
  const CommandResult automatic = run(draw + "--mode auto -o a.exr --stats-json a.json");
  EXPECT_EQ(automatic.exit_code, 0);
  EXPECT_EQ(automatic.err, "");
  EXPECT_FALSE(json("a.json")["system"].contains("gl"));
  expect_done("render" + scene("two-lights") + kSmallPicture + "--mode raytrace -o r.exr");
  EXPECT_TRUE(same_pixels(exr("a.exr"), exr("r.exr")));
  for (const std::string mode : {"raytrace", "raster"})
    EXPECT_EQ(run(draw + "--mode " + mode + " -o x.exr").err, "") << mode;
}

TEST_F(RenderTest, FiguresAreAPicturesAndATraceHasItsSamples) {
  expect_done("render" + scene("cornell") + kSmallPicture +
              "--mode raytrace --spp 4 --frames 0-1 --stats-json s.json --trace t.json");
  const nlohmann::json figures = json("s.json");
  EXPECT_EQ(figures["frames"], 2);
  expect_done("render" + scene("cornell") + kSmallPicture + "--mode raytrace --stats-json one.json");
  EXPECT_EQ(figures["rays"]["primary"], 4 * json("one.json")["rays"]["primary"].get<int>());
  int traced = 0;
  const nlohmann::json trace = json("t.json");
  for (const nlohmann::json& event : trace["traceEvents"]) traced += event["name"] == "raster" ? 1 : 0;
  EXPECT_EQ(traced, 8);
}

TEST_F(RenderTest, StatsHoldThePeakOfMemory) {
  expect_done("render" + scene("cornell") + kSmallPicture + "--mode raytrace --stats-json small.json");
  expect_done("render" + scene("cornell") +
              "--size 1600x1200 --quiet --mode raytrace --stats-json large.json");
  const double small = json("small.json")["memory"]["peak_bytes"],
               large = json("large.json")["memory"]["peak_bytes"];
  EXPECT_GT(small, 1e6);
  EXPECT_GT(large - small, 1600.0 * 1200.0 * 20.0);  // the picture alone: 16 bytes a pixel and ids
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep notes of what is used
  EXPECT_LT(large - small, 1600.0 * 1200.0 * 120.0);
#endif
}

// Frames are written while later ones are drawn: the failure is of the run all the same.
TEST_F(RenderTest, AFrameThatCannotBeWrittenEndsTheRun) {
  std::filesystem::create_directory(folder_ / "f0003.exr");
  const CommandResult result =
      run("render" + scene("cornell") + kSmallPicture + "--mode raytrace --turntable 40 -o f####.exr");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("f0003.exr: cannot be written"), std::string::npos) << result.err;
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(exists("f0000.exr") && exists("f0001.exr") && exists("f0002.exr"));
  EXPECT_FALSE(exists("f0004.exr"));
}

TEST_F(RenderTest, FilesOfARangeAreThoseOfSingleFrames) {
  const std::string draw = "render" + scene("two-lights") + kSmallPicture +
                           "--mode raytrace --deterministic --exchange sync --turntable 5 ";
  expect_done(draw + "-o f#.exr --preview f#.png");
  expect_done(draw + "--frames 3 -o g#.exr --preview g#.png --threads 1");
  for (const std::string ending : {".exr", ".png"})
    EXPECT_EQ(
        run_command("cd '" + folder_.string() + "' && cmp f3" + ending + " g3" + ending, folder_ / "scratch")
            .exit_code,
        0)
        << ending;
}

TEST_F(RenderTest, InterruptEndsWith130AndKeepsWhatWasFinished) {
  const CommandResult result = run_command(
      "cd '" + folder_.string() + "' && ( '" PINOCCHIO_PROGRAM "' render" + scene("cornell") +
          "--size 320x240 --quiet --mode raytrace --spp 4 --turntable 100000 -o f######.exr & pid=$!; "
          "while [ ! -e f000002.exr ]; do sleep 0.05; done; kill -INT $pid; wait $pid )",
      folder_ / "scratch");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == ".exr") {
      EXPECT_TRUE(read_exr(entry.path())) << entry.path();
    }
  }
}

// Mesa's softpipe claims OpenGL 3.3 and draws nothing where a shader reads gl_PrimitiveID.
TEST_F(RenderTest, ADriverThatDrawsNothingIsRefused) {
  const std::string draw = "render --size 40x30 -o a.exr" + scene("two-lights");
  for (const char* mode : {"hybrid", "raster"}) {
    const CommandResult result = run(draw + "--mode " + mode, "GALLIUM_DRIVER=softpipe");
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_NE(result.err.find("draws nothing"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("softpipe"), std::string::npos) << result.err;
    EXPECT_FALSE(exists("a.exr"));
  }
  EXPECT_EQ(run(draw + "--mode auto", "GALLIUM_DRIVER=softpipe").exit_code, 0);
  EXPECT_TRUE(exists("a.exr"));
}

TEST_F(RenderTest, AutoSaysWhyTheCpuDrawsAlone) {
  const CommandResult result =
      run("render --size 40x30 -o a.exr --mode auto --backend glfw" + scene("two-lights"), "DISPLAY=");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no OpenGL context"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("the CPU draws alone (--mode auto)"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace pinocchio
