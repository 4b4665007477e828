// What is written never costs what is read, and the exit code says what happened.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "pinocchio/exr.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

using OutputsTest = ProgramTest;

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Wrong usage, one line that names the file, and every file as it was.
class ApartTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    ASSERT_EQ(run("generate cornell -o x.gltf").exit_code, 0);
    write("path.json", R"({"keyframes": [{"frame": 0, "eye": [0, 1, 5], "target": [0, 1, 0]}]})");
    ASSERT_EQ(run("render x.gltf --size 16x12 -o a.exr").exit_code, 0);
    ASSERT_EQ(run("render x.gltf --size 16x12 -o b.exr").exit_code, 0);
    std::filesystem::create_symlink("x.gltf", folder_ / "link.json");
    std::filesystem::create_hard_link(folder_ / "x.gltf", folder_ / "hard.json");
    std::filesystem::create_directory(folder_ / "sub");
    std::filesystem::create_symlink("..", folder_ / "sub" / "up");
    for (const char* name : {"x.gltf", "x.bin", "path.json", "a.exr", "b.exr"})
      before_[name] = read_file(folder_ / name);
  }
  void expect_refused(const std::string& arguments) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find("the same file as"), std::string::npos) << result.err;
    for (const auto& [name, bytes] : before_) EXPECT_EQ(read_file(folder_ / name), bytes) << arguments;
  }
  std::map<std::string, std::string> before_;
};

TEST_F(ApartTest, NoOutputIsAnInput) {
  expect_refused("render x.gltf --stats-json x.gltf");
  expect_refused("render x.gltf --stats-json x.bin");
  expect_refused("render x.gltf --stats-json ./sub/up/x.gltf");
  expect_refused("render x.gltf --stats-json link.json");
  expect_refused("render x.gltf --stats-json hard.json");
  expect_refused("render x.gltf --path path.json --stats-json path.json");
  expect_refused("view x.gltf --environment a.exr --stats-json a.exr");
  expect_refused("measure x.gltf --trace x.bin");
  expect_refused("compare a.exr b.exr --heatmap a.exr");
}

TEST_F(ApartTest, NoOutputIsAnother) {
  expect_refused("render x.gltf --size 16x12 --preview y.png --stats-json sub/../y.png");
  expect_refused("measure x.gltf --stats-json y.json --trace ./y.json");
}

// Any frame's file of a range may be an existing one by another name.
TEST_F(ApartTest, NoFrameOfARangeIsAnInputOrAnother) {
  std::filesystem::create_symlink("x.gltf", folder_ / "f07.exr");
  expect_refused("render x.gltf --size 16x12 --turntable 9 -o f##.exr");
  EXPECT_EQ(run("render x.gltf --size 16x12 --turntable 9 --frames 0-6 -o f##.exr").exit_code, 0);
  std::filesystem::create_directory(folder_ / "at03");
  std::filesystem::create_symlink("../path.json", folder_ / "at03" / "y.png");
  expect_refused("render x.gltf --size 16x12 --path path.json --frames 1-3 --preview at##/y.png");
  std::filesystem::create_symlink("g1.exr", folder_ / "g2.exr");
  expect_refused("render x.gltf --size 16x12 --turntable 3 -o g#.exr");
  expect_refused("render x.gltf --size 16x12 --turntable 3 -o h#.exr --stats-json sub/../h2.exr");
}

TEST_F(OutputsTest, AFolderMayBeCalledWithAHash) {
  const std::string cornell = scene("cornell.gltf");
  std::filesystem::create_directory(folder_ / "C#");
  EXPECT_EQ(run("render" + cornell + "--size 16x12 --preview 'C#/a.png'").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "C#" / "a.png"));
  EXPECT_EQ(run("render" + cornell + "--size 16x12 --turntable 2 --preview 'C#/b#-##.png'").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "C#" / "b#-01.png"));
}

TEST_F(OutputsTest, StandardOutputIsChecked) {
  for (const std::string arguments : {"info --settings", "--help", "render --help", "info --system --json"}) {
    const CommandResult result = run(arguments + " > /dev/full");
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_NE(result.err.find("standard output cannot be written"), std::string::npos) << result.err;
  }
}

TEST_F(OutputsTest, BadInputIsOneLineAndTheRightCode) {
  const auto expect = [&](int code, const std::string& arguments, const std::string& said) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find(said), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  const std::string cornell = scene("cornell.gltf");
  expect(2, "render" + cornell + "--preview x.png --exposure nan", "not a number of stops");
  expect(2, "render" + cornell + "--preview x.png --path .", "cannot be read");
  expect(2, "render" + cornell + "--preview x.png --up 0,0,0", "not a direction");
  expect(2, "render" + cornell + "--preview x.png --eye 1e30,0,0", "not within 1e9");
  expect(2, "render" + cornell + "--preview x.png --target 0,1e30,0", "not within 1e9");
  ASSERT_EQ(mkfifo((folder_ / "pipe.gltf").c_str(), 0600), 0);
  expect(4, "info pipe.gltf", "pipe");
  EXPECT_EQ(files(), 1u);  // the pipe
}

TEST_F(OutputsTest, TooLittleMemoryIsAnError) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers want more address space than a limit leaves";
#endif
  const std::string cornell = scene("cornell.gltf");
  const CommandResult result =
      run_command("ulimit -v 600000; cd '" + folder_.string() + "' && '" PINOCCHIO_PROGRAM "' render" +
                      cornell + "--mode raytrace --size 8000x8000 -o x.exr",
                  folder_ / "scratch");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("memory"), std::string::npos) << result.err;
  EXPECT_FALSE(exists("x.exr"));
}

// A limit on a file's size fails a write in its middle, as a full disk does.
TEST_F(OutputsTest, ADiskThatFillsIsOneLineAndLosesNothing) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers write files of their own";
#endif
  const std::string draw = "render" + scene("cornell.gltf") + "--mode raytrace --size 128x96 ";
  ASSERT_EQ(run(draw + "-o a.exr").exit_code, 0);
  ASSERT_EQ(run(draw + "-o b.exr --light 1,1,1").exit_code, 0);
  std::filesystem::create_directory(folder_ / "kept");
  const std::map<std::string, std::string> outputs{
      {"x.exr", draw + "-o x.exr"},
      {"raw.exr", draw + "-o raw.exr --compression none"},
      {"piz.exr", draw + "-o piz.exr --compression piz"},
      {"x.png", draw + "--preview x.png"},
      {"x.glb", "generate speedboat -o x.glb"},
      {"x.gltf", "generate speedboat -o x.gltf"},
      {"x.obj", "generate speedboat -o x.obj"},
      {"t.json",
       "measure" + scene("cornell.gltf") + "--mode raytrace --size 32x24 --frames 40 --trace t.json"},
      {"h.png", "compare a.exr b.exr --heatmap h.png"},
  };
  for (const auto& [file, command] : outputs) write(file, "old");
  const std::size_t before = files();
  for (const auto& [file, command] : outputs) {
    const CommandResult result =
        run_command("ulimit -f 4; cd '" + folder_.string() + "' && '" PINOCCHIO_PROGRAM "' " + command,
                    folder_ / "scratch");
    EXPECT_EQ(result.exit_code, 1) << command << "\n" << result.err;
    EXPECT_NE(result.err.find(file + ": cannot be written: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("is the disk full?"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(read_file(folder_ / file), "old") << command;
    EXPECT_EQ(files(), before) << command;
  }
}

TEST_F(OutputsTest, LinksAreKeptAndReadOnlyFilesRefused) {
  const std::string render = "render" + scene("cornell.gltf") + "--size 16x12 -o ";
  std::filesystem::create_directory(folder_ / "store");
  std::filesystem::create_symlink("store/x.exr", folder_ / "x.exr");  // its target is not there yet
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(run(render + "x.exr").exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "x.exr"));
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "store" / "x.exr"));
  }
  write("kept.exr", "kept");
  std::filesystem::permissions(folder_ / "kept.exr", std::filesystem::perms::owner_read);
  const CommandResult result = run(render + "kept.exr");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("read-only"), std::string::npos) << result.err;
  EXPECT_EQ(read_file(folder_ / "kept.exr"), "kept");
}

TEST_F(OutputsTest, SkipExistingTakesWholeFilesOfTheSameSettingsAlone) {
  ASSERT_EQ(run("generate cornell -o x.gltf").exit_code, 0);
  const std::string render = "render x.gltf --size 32x24 --turntable 4 -o f##.exr --skip-existing ";
  const auto drawn = [&](const std::string& more) {
    const CommandResult result = run(render + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    int count = 0;
    for (std::size_t at = 0; (at = result.out.find(".exr\n", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(drawn(""), 4);
  const std::string first = read_file(folder_ / "f01.exr");
  EXPECT_EQ(drawn(""), 0);
  EXPECT_EQ(drawn("--threads 1"), 0);  // no pixel changes with it
  std::filesystem::resize_file(folder_ / "f01.exr", first.size() - 100);
  std::filesystem::remove(folder_ / "f02.exr");
  write("f03.exr", "");
  EXPECT_EQ(drawn(""), 3);
  EXPECT_EQ(drawn("--spp 2"), 4);
  EXPECT_EQ(drawn("--spp 2 --crop 0,0,8,8"), 4);
  EXPECT_EQ(drawn("--spp 2 --crop 0,0,8,8 --light 0,1,0,0.5"), 4);
  EXPECT_EQ(drawn("--spp 2 --crop 0,0,8,8 --light 0,1,0,0.6"), 4);
  EXPECT_EQ(drawn("--spp 2 --crop 0,0,8,8 --light 0,1,0,0.6 --compression piz"), 4);
  EXPECT_EQ(drawn("--spp 2 --crop 0,0,8,8 --light 0,1,0,0.6 --compression piz"), 0);
}

// What no setting says: each of these changes pixels.
TEST_F(OutputsTest, SkipExistingDrawsAgainWhatAnyInputChanges) {
  ASSERT_EQ(run("generate cornell -o x.gltf").exit_code, 0);
  const auto sky = [this](const std::string& name, float radiance) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    ExrFile exr{{2, 1}, {{0, 0}, {2, 1}}, {}, {}, {}};
    for (const char* channel : {"R", "G", "B"})
      exr.channels.push_back({channel, ExrChannel::Type::half, {radiance, radiance}, {}});
    write_exr(folder_ / name, exr);
  };
  sky("sky.exr", 1.0f);
  sky("other.exr", 2.0f);
  sky("folder/sky.exr", 2.0f);
  const auto is_drawn = [&](const std::string& more) {
    const CommandResult result =
        run("render x.gltf --size 16x12 --mode raytrace -o f.exr --preview f.png --skip-existing " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out.find("f.exr") != std::string::npos;
  };
  const auto expect_new = [&](const std::string& more) {
    EXPECT_TRUE(is_drawn(more)) << more;
    EXPECT_FALSE(is_drawn(more)) << more;
  };
  for (const char* more :
       {"", "--precise", "--lens-radius 0.1", "--lens-radius 0.2", "--lens-radius 0.2 --focus 3",
        "--lens-radius 0.2 --focus 4", "--environment sky.exr", "--environment other.exr",
        "--environment sky.exr", "--environment folder/sky.exr", "--exposure 1", "--exposure 2",
        "--tone-map aces", "--tone-map reinhard"})
    expect_new(more);
  expect_new("--environment sky.exr");
  sky("sky.exr", 3.0f);
  expect_new("--environment sky.exr");
  expect_new("");
  std::string bytes = read_file(folder_ / "x.bin");
  bytes[5] = static_cast<char>(bytes[5] ^ 1);
  write("x.bin", bytes);
  expect_new("");
  write("f.png", read_file(folder_ / "f.png").substr(0, 100));
  expect_new("");
}

// The layer motion leads to another frame, whose camera and time no other part of the header says.
TEST_F(OutputsTest, SkipExistingDrawsAgainWhereMotionLeadsElsewhere) {
  const auto drawn = [&](const std::string& more) {
    const CommandResult result =
        run("render" + scene("cornell.gltf") +
            "--size 16x12 --mode raytrace -o f#.exr --skip-existing --frames 0 " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out.find("f0.exr") != std::string::npos;
  };
  const std::string motion = "--aov motion ";
  for (const std::string more : {"--turntable 4", "--turntable 8", "--turntable 8 --motion-to former"}) {
    EXPECT_TRUE(drawn(motion + more)) << more;
    EXPECT_FALSE(drawn(motion + more)) << more;
  }
  EXPECT_TRUE(drawn("--aov none --turntable 8"));
  EXPECT_FALSE(drawn("--aov none --turntable 4"));  // frame 0 is the same picture
}

// Files that were copied, fetched again or touched are the same; those that were changed are not, whatever
// their time.
TEST_F(OutputsTest, SkipExistingAsksNoClock) {
  ASSERT_EQ(run("generate cornell -o x.gltf").exit_code, 0);
  const std::string render = "render x.gltf --size 16x12 -o f.exr --skip-existing";
  const auto is_drawn = [&] { return run(render).out.find("f.exr") != std::string::npos; };
  EXPECT_TRUE(is_drawn());
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(folder_ / "x.bin", now + std::chrono::hours(24));
  EXPECT_FALSE(is_drawn());
  write("x.gltf", read_file(folder_ / "x.gltf") + " ");
  std::filesystem::last_write_time(folder_ / "x.gltf", now - std::chrono::hours(24));
  EXPECT_TRUE(is_drawn());
}

TEST_F(OutputsTest, DeterministicFilesAreTheSameToTheByte) {
  const std::string render =
      "render" + scene("two-lights.gltf") + "--size 96x72 --mode raytrace --deterministic -o ";
  ASSERT_EQ(run(render + "a.exr").exit_code, 0);
  const std::string expected = read_file(folder_ / "a.exr");
  const std::vector<std::string> all{"--threads 1", "--threads 3", "--isa scalar", four_lanes()};
  for (const std::string& more : all) {
    ASSERT_EQ(run(render + "b.exr " + more).exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "b.exr"), expected) << more;
  }
}

TEST_F(OutputsTest, ABackgroundIsInEveryFile) {
  write("t.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  // The file is no height of the option before it.
  const std::string options = " t.obj --mode raytrace --size 32x24 ",
                    render = "render --shadow-catcher" + options;
  const auto color_type = [&](const std::string& more) {  // of the PNG: 2 RGB, 6 RGBA
    const CommandResult result = run(render + more + " --preview t.png");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return static_cast<int>(read_file(folder_ / "t.png").at(25));
  };
  EXPECT_EQ(color_type("--background transparent"), 6);
  EXPECT_EQ(color_type("--background '#336699'"), 2);
  EXPECT_EQ(color_type(""), 2);
  EXPECT_EQ(run(render + "--raw - > three").exit_code, 0);
  EXPECT_EQ(run(render + "--background transparent --raw - > four").exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "three").size(), 32u * 24u * 3u);
  EXPECT_EQ(read_file(folder_ / "four").size(), 32u * 24u * 4u);
  const auto skipped = [&](const std::string& more) {
    const CommandResult result = run("render" + options + "-o t.exr --preview t.png --skip-existing " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out.find("t.exr\n") == std::string::npos;
  };
  EXPECT_FALSE(skipped("--background transparent"));
  EXPECT_TRUE(skipped("--background transparent"));
  EXPECT_FALSE(skipped("--background white"));
  EXPECT_FALSE(skipped("--background white --shadow-catcher off"));
  EXPECT_TRUE(skipped("--background '#ffffff' --shadow-catcher off"));
}

TEST_F(OutputsTest, BackgroundsThatCannotBeSayWhatCan) {
  write("t.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto expect = [&](const std::string& arguments, int code, const std::string& said) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code) << arguments;
    EXPECT_NE((result.out + result.err).find(said), std::string::npos) << result.out << result.err;
  };
  expect("render t.obj --preview t.png --background 1,2", 2, "'1,2' is not environment, studio, transparent");
  expect("render t.obj --preview t.png --shadow-catcher=deep", 2, "'deep' is not off, lowest or a height");
  expect("render t.obj --preview t.png --shadow-catcher 0 --design 2", 2, "shadow_catcher does not travel");
  expect("render t.obj --size 32x24 --preview t.png --design 2", 0, "the studio's ground shadow is left out");
  EXPECT_EQ(run("render t.obj --size 32x24 --preview t.png --mode raster").err.find("ground shadow"),
            std::string::npos);
  expect("info t.obj --plan --background transparent", 0, "behind the scene is nothing");
  const std::string render = "render t.obj --mode raytrace --size 32x24 --preview t.png --background-blur ";
  expect(render + "2", 2, "'2' is not a number from 0 to 1");
  expect(render + "0.5 --background white", 0, "--background-blur changes nothing");
  expect(render + "0.5 --light 0,0,5", 0, "--background-blur changes nothing");
  EXPECT_EQ(run(render + "0.5").err.find("--background-blur"), std::string::npos);  // the studio's sky
  expect("info t.obj --plan", 0, "the shadow catcher at height 0 takes shadow rays");
}

}  // namespace
}  // namespace pinocchio
