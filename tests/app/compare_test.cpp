// The verb compare: figures, files, exit codes.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "pinocchio/exr.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class CompareVerbTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_flat("a.exr", 0.75f);
    write_flat("b.exr", 0.5f);
  }

  // A picture of one grey, its first pixel's red set to `first`.
  void write_flat(const std::string& name, float value, float first = -1.0f,
                  glm::ivec2 size = {16, 12}) const {
    ExrFile exr;
    exr.display_size = size;
    exr.data_window = {{0, 0}, size};
    const auto pixels = static_cast<std::size_t>(size.x * size.y);
    for (const char* channel : {"B", "G", "R"})
      exr.channels.push_back({channel, ExrChannel::Type::half, std::vector<float>(pixels, value), {}});
    if (first != -1.0f) exr.channels.back().values[0] = first;
    exr.channels.push_back(
        {"shadow.mask", ExrChannel::Type::uint, {}, std::vector<std::uint32_t>(pixels, 1)});
    if (value > 0.6f) exr.channels.back().uints[5] = 0;
    write_exr(folder_ / name, exr);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void expect_error(const std::string& arguments, int exit_code, const std::string& words) const {
    const CommandResult result = run("compare " + arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }

  [[nodiscard]] nlohmann::json figures(const std::string& arguments) const {
    const CommandResult result = run("compare --json " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return nlohmann::json::parse(result.out, nullptr, false);
  }
};

TEST_F(CompareVerbTest, FiguresAsText) {
  const CommandResult result = run("compare a.exr b.exr --channel R --channel shadow.mask");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* words :
       {"rmse    0.25", "relmse  0.24", "psnr    12.04", "max     0.25", "flip    0.", "67 pixels per degree",
        "bits that differ: 1 of 192", "R: 192 of 192 pixels differ", "shadow.mask: 1 of 192 pixels differ"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
}

TEST_F(CompareVerbTest, FiguresAsJson) {
  const nlohmann::json json = figures("a.exr b.exr --channels");
  EXPECT_NEAR(json["rmse"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(json["relmse"].get<double>(), 0.0625 / 0.26, 1e-9);
  EXPECT_NEAR(json["psnr"].get<double>(), 12.0412, 1e-4);
  EXPECT_NEAR(json["mask"].get<double>(), 1.0 / 192.0, 1e-9);
  EXPECT_EQ(json["channels"].size(), 4u);
  EXPECT_EQ(json["mask_bits"]["differing"], 1);
  EXPECT_LT(figures("a.exr b.exr --ppd 20")["flip"].get<double>(), 1.0);
}

TEST_F(CompareVerbTest, AFileAgainstItself) {
  const nlohmann::json json = figures("a.exr a.exr --channels --max-error psnr=99 --max-error max=0");
  for (const char* metric : {"rmse", "relmse", "max", "flip", "mask"}) EXPECT_EQ(json[metric], 0.0) << metric;
  EXPECT_TRUE(json["psnr"].is_null());
}

TEST_F(CompareVerbTest, WritesAHeatmap) {
  EXPECT_EQ(run("compare a.exr b.exr --heatmap map.png").exit_code, 0);
  std::ifstream png(folder_ / "map.png", std::ios::binary);
  std::string begin(4, ' ');
  png.read(begin.data(), 4);
  EXPECT_EQ(begin, "\x89PNG");
  expect_error("a.exr b.exr --heatmap no/such/folder/map.png", 1, "no/such/folder");
}

TEST_F(CompareVerbTest, Limits) {
  EXPECT_EQ(run("compare a.exr b.exr --max-error rmse=0.2501 --max-error psnr=12").exit_code, 0);
  expect_error("a.exr b.exr --max-error rmse=0.2", 5, "rmse 0.25 is above 0.2");
  expect_error("a.exr b.exr --max-error psnr=13 --max-error max=1", 5, "psnr 12.0412 is below 13");
  expect_error("a.exr b.exr --max-error mask=0.001 --max-error flip=0.001", 5, "is above 0.001, flip");
  expect_error("a.exr b.exr --json --max-error relmse=0.1", 5, "relmse");
}

TEST_F(CompareVerbTest, FilesThatCannotBeCompared) {
  write("text.exr", "hello");
  write_flat("small.exr", 0.5f, -1.0f, {8, 12});
  write_flat("nan.exr", 0.5f, std::numeric_limits<float>::quiet_NaN());
  write_flat("inf.exr", 0.5f, std::numeric_limits<float>::infinity());
  expect_error("a.exr missing.exr", 4, "missing.exr: there is no such file");
  expect_error("text.exr b.exr", 4, "text.exr: cannot be read as EXR");
  expect_error("a.exr small.exr", 1, "16x12, that of small.exr is 8x12");
  expect_error("a.exr nan.exr", 1, "nan.exr: NaN or infinity in R, G or B of 1 pixel, first at (0, 0)");
  expect_error("inf.exr a.exr", 1, "inf.exr: NaN or infinity");
  expect_error("a.exr b.exr --channel Z", 1, "a.exr: has no channel 'Z'");
}

TEST_F(CompareVerbTest, FoldersPairByNameAndTellOfEach) {
  for (const char* folder : {"new", "golden"}) std::filesystem::create_directories(folder_ / folder / "sub");
  for (const char* file : {"one.exr", "sub/two.exr"}) {
    write_flat(std::string("golden/") + file, 0.5f);
    write_flat(std::string("new/") + file, file == std::string("one.exr") ? 0.5f : 0.55f);
  }
  const nlohmann::json json = figures("new golden");
  EXPECT_EQ(json["pairs"].size(), 2u);
  EXPECT_EQ(json["pairs"][1]["name"], "sub/two.exr");
  EXPECT_NEAR(json["overall"]["rmse"]["worst"].get<double>(), 0.05, 1e-3);
  EXPECT_NEAR(json["overall"]["rmse"]["mean"].get<double>(), 0.025, 1e-3);
  EXPECT_EQ(json["failures"], 0);
  const CommandResult table =
      run("compare new golden --heatmap maps --junit report.xml --max-error rmse=0.01");
  EXPECT_EQ(table.exit_code, 5);
  EXPECT_NE(table.out.find("worst"), std::string::npos);
  EXPECT_NE(table.err.find("new/sub/two.exr: rmse 0.0"), std::string::npos) << table.err;
  EXPECT_TRUE(exists("maps/one.exr.png") && exists("maps/sub/two.exr.png"));
  expect_error("new golden --heatmap ./new", 2, "--heatmap ./new: within new, whose pictures are compared");
  expect_error("new golden --heatmap golden/maps", 2, "within golden");
  const std::string xml = text_of("report.xml");
  EXPECT_NE(xml.find("tests=\"2\" failures=\"1\" errors=\"0\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<testcase classname=\"compare\" name=\"sub/two.exr\">\n      <failure message="),
            std::string::npos)
      << xml;
  // A picture that is missing fails the comparison.
  std::filesystem::remove(folder_ / "new" / "one.exr");
  expect_error("new golden --quiet", 2, "--quiet");
  const CommandResult missing = run("compare new golden");
  EXPECT_EQ(missing.exit_code, 5);
  EXPECT_NE(missing.err.find("has no counterpart in new"), std::string::npos) << missing.err;
}

TEST_F(CompareVerbTest, JunitIsUtf8WhateverTheNames) {
  for (const char* folder : {"new", "golden"}) {
    std::filesystem::create_directories(folder_ / folder);
    write_flat(folder + std::string("/grey\xff.exr"), 0.5f);
  }
  EXPECT_EQ(run("compare new golden --junit report.xml").exit_code, 0);
  const std::string xml = text_of("report.xml");
  EXPECT_NE(xml.find("name=\"grey.exr\""), std::string::npos) << xml;
  EXPECT_EQ(xml.find('\xff'), std::string::npos) << xml;
}

TEST_F(CompareVerbTest, SequencesPairByNumber) {
  for (int i = 8; i < 11; ++i) {
    const std::string number = (i < 10 ? "000" : "00") + std::to_string(i);
    write_flat("a." + number + ".exr", 0.5f);
    write_flat("b_" + number + ".exr", 0.5f);
  }
  EXPECT_EQ(figures("a.####.exr b_####.exr --max-error max=0")["pairs"].size(), 3u);
  write_flat("c_8.exr", 0.5f);
  write_flat("c_9.exr", 0.5f);
  write_flat("c_10.exr", 0.5f);
  const nlohmann::json pairs = figures("a.####.exr c_#.exr --max-error max=0")["pairs"];
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[2]["name"], "0010");
  expect_error("a.####.exr b.exr", 2, "give #### in both names or in none");
  expect_error("c.####.exr b_####.exr", 4, "there is no EXR or PNG");
}

TEST_F(CompareVerbTest, PngAgainstPngAndExr) {
  const std::string render = "render" + scene("cornell.gltf") + "--size 64x48 ";
  ASSERT_EQ(run(render + "-o x.exr --preview x.png").exit_code, 0);
  ASSERT_EQ(run(render + "--spp 4 --preview y.png").exit_code, 0);
  EXPECT_EQ(figures("x.png x.png")["max"], 0.0);
  EXPECT_GT(figures("x.png y.png")["rmse"].get<double>(), 0.0);
  EXPECT_LT(figures("x.png x.exr")["flip"].get<double>(), 0.01);
  write("text.png", "hello");
  expect_error("text.png x.png", 4, "is not of a format that is read");
}

TEST_F(CompareVerbTest, Usage) {
  expect_error("a.exr", 2, "B is required");
  for (const char* limit : {"rmse", "speed=1", "rmse=", "rmse=x", "rmse=nan", "rmse=-1", "=1"})
    expect_error(std::string("a.exr b.exr --max-error ") + limit, 2, limit);
  expect_error("a.exr b.exr --heatmap map.jpg", 2, "does not end in .png");
  for (const char* ppd : {"0", "nan", "1e9", "x"})
    expect_error(std::string("a.exr b.exr --ppd ") + ppd, 2, "--ppd");
}

}  // namespace
}  // namespace pinocchio
