#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

const std::string kSmallChart = "-o d --quick --size 48x36 --repeat 1 --quiet ";

class ChartTest : public ProgramTest {
 protected:
  // Draws no page, for those that look at the figures alone: matplotlib takes longer than measuring them.
  [[nodiscard]] CommandResult run_without_page(const std::string& arguments) const {
    write("scratch/matplotlib.py", "raise ImportError('none')\n");
    return run(arguments, "PYTHONPATH=\"$PWD/scratch\"");
  }
  [[nodiscard]] nlohmann::json results() const {
    std::ifstream in(folder_ / "d/results.json");
    return nlohmann::json::parse(in, nullptr, false);
  }
  [[nodiscard]] std::set<std::string> values_of(const std::string& axis) const {
    std::set<std::string> values;
    const nlohmann::json json = results();
    for (const nlohmann::json& point : json["points"])
      if (point["axis"] == axis) values.insert(point["value"].get<std::string>());
    return values;
  }
  [[nodiscard]] std::string first_line(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::string line;
    std::getline(in, line);
    return line;
  }
};

TEST_F(ChartTest, WritesFiguresPicturesAndAPageOfCharts) {
  const CommandResult result = run("chart" + scene("two-lights") + kSmallChart +
                                   "--only design,exchange,reflection-format,mask-scale,spp");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* file :
       {"index.html", "explore.html", "results.csv", "pictures/reference-centre-3.exr", "error-flip.svg",
        "error-rmse.svg", "error-relmse.svg", "error-bytes.svg", "axis-design.svg",
        "pictures/design-raster-flip.png", "pictures/reference-centre.png", "pictures/reference-area.png"})
    EXPECT_TRUE(exists(std::string("d/") + file)) << file;
  EXPECT_EQ(values_of("exchange"),
            (std::set<std::string>{"1 sync", "1 pipelined", "1 reproject", "2 sync", "2 pipelined"}));
  EXPECT_EQ(values_of("reflection-format"), (std::set<std::string>{"rgb8", "rgb9e5", "half", "float"}));
  EXPECT_EQ(values_of("mask-scale"), (std::set<std::string>{"1", "1/2", "1/4"}));
  EXPECT_EQ(first_line("d/results.csv"),
            "axis,value,options,ratio,ratio_median,frame_ms,raster_ms,cpu_ms,raster_cpu_ms,"
            "round_ms,round_low_ms,round_high_ms,latency_ms,latency_frames,"
            "age_frames,bytes_gpu_to_cpu,bytes_cpu_to_gpu,reference,rmse,relmse,flip,worst,pareto");
  // In one file: data, pictures and programs are in it, and nothing is fetched.
  std::ifstream page(folder_ / "d/explore.html");
  std::ostringstream text;
  text << page.rdbuf();
  EXPECT_NE(text.str().find("--mode raytrace"), std::string::npos);
  std::string whole = text.str();
  constexpr std::string_view kNoIcon = "href=\"data:,\"";  // which keeps browsers from asking for one
  if (const std::size_t icon = whole.find(kNoIcon); icon != std::string::npos)
    whole.erase(icon, kNoIcon.size());
  for (const char* outside : {"/*DATA*/", "src=\"http", "href=", "@import", "fetch("})
    EXPECT_EQ(whole.find(outside), std::string::npos) << outside;
  const CommandResult xml =
      run_command("cd '" + folder_.string() +
                      "/d' && python3 -c 'import glob, xml.dom.minidom as m; [m.parse(f) for f in "
                      "glob.glob(\"*.svg\")]'",
                  folder_ / "scratch");
  EXPECT_EQ(xml.exit_code, 0) << xml.err;
}

TEST_F(ChartTest, ErrorsAreThoseOfWhatIsOnTheScreen) {
  ASSERT_EQ(run_without_page("chart" + scene("cornell") + kSmallChart + "--only design,exchange,mask-scale")
                .exit_code,
            0);
  std::map<std::string, nlohmann::json> points;
  const nlohmann::json json = results();
  for (const nlohmann::json& point : json["points"])
    points[point["axis"].get<std::string>() + " " + point["value"].get<std::string>()] = point;
  // Sees no shadow and no mirror; sees the motion two frames late; sees all.
  EXPECT_GT(points["design raster"]["flip"], 0.05);
  EXPECT_LT(points["design raytrace"]["rmse"], 1e-3);
  EXPECT_LT(points["exchange 1 sync"]["rmse"], 1e-3);
  EXPECT_GT(points["exchange 1 pipelined"]["flip"], 0.01);
  EXPECT_EQ(points["exchange 1 pipelined"]["latency_frames"], 2);
  EXPECT_EQ(points["exchange 1 reproject"]["age_frames"], 2);
  EXPECT_LT(points["exchange 1 reproject"]["flip"], points["exchange 1 pipelined"]["flip"]);
  EXPECT_LT(points["mask-scale 1/2"]["flip"], points["mask-scale 1/4"]["flip"]);
  EXPECT_GT(points["exchange 1 sync"]["latency_ms"], 0.0);
  EXPECT_EQ(points["design 2 slides"]["bytes_gpu_to_cpu"], 48 * 36 * 19);
}

TEST_F(ChartTest, TheFrontIsBeatenByNoPoint) {
  ASSERT_EQ(
      run_without_page("chart" + scene("cornell") + kSmallChart + "--only design,mask-scale,depth").exit_code,
      0);
  const nlohmann::json json = results();
  const nlohmann::json& points = json["points"];
  const auto on_front = [](const nlohmann::json& point) {
    const nlohmann::json& fronts = point["pareto"];
    return std::find(fronts.begin(), fronts.end(), "flip") != fronts.end();
  };
  // Raytrace may be the fastest and the most exact, and alone on it.
  std::size_t members = 0;
  for (const nlohmann::json& point : points) {
    bool beaten = false;
    for (const nlohmann::json& other : points)
      beaten = beaten || (other["ratio"] <= point["ratio"] && other["flip"] <= point["flip"] &&
                          (other["ratio"] < point["ratio"] || other["flip"] < point["flip"]));
    if (on_front(point)) ++members;
    EXPECT_FALSE(on_front(point) && beaten) << point.dump(2);
  }
  EXPECT_GE(members, 1u);
}

TEST_F(ChartTest, WhatIsMeasuredIsNotMeasuredAgain) {
  const std::string chart = "chart" + scene("cornell") + kSmallChart;
  ASSERT_EQ(run_without_page(chart + "--only depth").exit_code, 0);
  nlohmann::json json = results();
  const std::size_t before = json["points"].size();
  for (nlohmann::json& point : json["points"]) point["latency_ms"] = 12345.0;
  std::ofstream(folder_ / "d/results.json") << json.dump();
  ASSERT_EQ(run_without_page(chart + "--only depth,tiles").exit_code, 0);
  json = results();
  ASSERT_GT(json["points"].size(), before);
  for (std::size_t i = 0; i < before; ++i) EXPECT_EQ(json["points"][i]["latency_ms"], 12345.0);
  EXPECT_EQ(values_of("tiles").size(), 2u);
}

TEST_F(ChartTest, CtrlCKeepsWhatIsDone) {
  const std::string program =
      "'" PINOCCHIO_PROGRAM "' chart" + scene("cornell") + "-o d --size 100x75 --quiet";
  const CommandResult result = run_command(
      "cd '" + folder_.string() + "' && " + program + " & pid=$!; while kill -0 $pid && [ ! -e '" +
          folder_.string() + "/d/results.csv' ]; do sleep 0.05; done; kill -INT $pid; wait $pid",
      folder_ / "scratch");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_GE(results()["points"].size(), 1u);
}

TEST_F(ChartTest, AFolderHoldsOneChart) {
  ASSERT_EQ(run_without_page("chart" + scene("cornell") + kSmallChart + "--only tiles").exit_code, 0);
  const std::string other = "chart" + scene("two-lights") + kSmallChart + "--only tiles";
  const CommandResult refused = run(other);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("d/results.json: is the chart of another run (scene differs)"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("--restart"), std::string::npos);
  EXPECT_EQ(run_without_page(other + " --restart").exit_code, 0);
  EXPECT_EQ(results()["run"]["scene"]["name"], "two-lights");
  EXPECT_EQ(run(other + " --projection orthographic").exit_code, 2) << "another camera's chart";
  write("d/results.json", "{\"run\":");
  EXPECT_EQ(run(other).exit_code, 2);
  write("d/results.json", "{\"run\": {}, \"points\": [{}]}");
  EXPECT_EQ(run(other).exit_code, 2);
}

// The program's own options, by which it resolves to the settings that were measured.
TEST_F(ChartTest, TheOptionsItNamesDrawTheScene) {
  ASSERT_EQ(
      run_without_page("chart" + scene("two-lights") + kSmallChart + "--only design,tiles,cutoff,combined")
          .exit_code,
      0);
  std::size_t drawn = 0;
  for (const nlohmann::json& json = results(); const nlohmann::json& point : json["points"]) {
    const auto options = point["options"].get<std::string>();
    if (options.empty()) continue;
    ++drawn;
    const CommandResult result =
        run("render" + scene("two-lights") + "--size 48x36 --quiet --preview d/x.png --stats-json d/x.json " +
            options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::ifstream in(folder_ / "d/x.json");
    EXPECT_EQ(nlohmann::json::parse(in, nullptr, false)["plan"], point["settings"]) << options;
  }
  EXPECT_GE(drawn, 10u);
}

TEST_F(ChartTest, WithoutMatplotlibTheFiguresAreThereAndOneLineSaysWhatToInstall) {
  const CommandResult result = run_without_page("chart" + scene("cornell") + kSmallChart + "--only tiles");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("install python3-matplotlib"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(exists("d/results.csv"));
  EXPECT_FALSE(exists("d/index.html"));
}

TEST_F(ChartTest, TimeIsTheFramesOrTheProcessors) {
  for (const std::string clock : {"frame", "cpu"}) {
    ASSERT_EQ(
        run_without_page("chart" + scene("cornell") + kSmallChart + "--restart --only tiles --clock " + clock)
            .exit_code,
        0);
    const nlohmann::json json = results();
    const std::string time = clock == "cpu" ? "cpu_ms" : "frame_ms";
    const std::string raster = clock == "cpu" ? "raster_cpu_ms" : "raster_ms";
    double least = 1e9;
    for (const nlohmann::json& point : json["points"]) least = std::min(least, point[raster].get<double>());
    EXPECT_GT(least, 0.0);
    for (const nlohmann::json& point : json["points"])
      EXPECT_DOUBLE_EQ(point["ratio"], point[time].get<double>() / least);
  }
}

// Eight texels of the Radiance format, each light times (1, 1/2, 1/4).
std::string even_sky(char exponent) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) text += std::string("\x80\x40\x20", 3) + exponent;
  return text;
}

TEST_F(ChartTest, AnEnvironmentIsChartedAgainstTheReferenceThatSeesIt) {
  write("sky.hdr", even_sky('\x81'));
  write("dim.hdr", even_sky('\x80'));
  const std::string samples = kSmallChart + "--only spp ";
  ASSERT_EQ(
      run_without_page("chart" + scene("cornell") + samples + "--environment sky.hdr --eye 0,1,9").exit_code,
      0);
  const nlohmann::json json = results();
  std::map<std::string, double> rmse;
  for (const nlohmann::json& point : json["points"]) rmse[point["value"].get<std::string>()] = point["rmse"];
  EXPECT_LT(rmse.at("4"), 0.7 * rmse.at("1"));  // samples converge towards the reference
  const CommandResult other = run("chart" + scene("cornell") + samples + "--environment dim.hdr --eye 0,1,9");
  EXPECT_EQ(other.exit_code, 2) << "the folder holds the figures of another sky";
}

TEST_F(ChartTest, WrongUseIsOneLine) {
  const struct {
    std::string arguments;
    int exit_code;
    const char* says;
  } kCases[] = {
      {kSmallChart + "--only depth,colour", 2, "'colour' is not an axis; there are design, exchange"},
      {"--quick", 2, "--output"},
      {kSmallChart + "--turntable 4", 2, "the camera's motion has 4 frames"},
      {kSmallChart + "--repeat 0", 2, "--repeat"},
      {kSmallChart + "--indirect 2", 2, "--indirect"},
      {kSmallChart + "--stability", 2, "give a SCENE or --stability"},
      {kSmallChart + "--projection panorama", 2, "cannot draw a panorama"},
      {"-o file/d --quick", 1, "the folder cannot be made"}};
  write("file", "");
  for (const auto& wrong : kCases) {
    const CommandResult result = run("chart" + scene("cornell") + wrong.arguments);
    EXPECT_EQ(result.exit_code, wrong.exit_code) << wrong.arguments;
    EXPECT_NE(result.err.find(wrong.says), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(ChartTest, StabilityGoesOnWhereItWasEndedAndFindsNoFailureOfTheDefaults) {
  EXPECT_EQ(run("chart " + kSmallChart).exit_code, 2);  // without a scene
  const CommandResult ended =
      run_command("cd '" + folder_.string() +
                      "' && ( '" PINOCCHIO_PROGRAM
                      "' chart --stability --quick -o d & pid=$!; while kill -0 $pid && [ ! -e "
                      "d/stability-part.json ]; do sleep 0.01; done; kill -INT $pid; wait $pid )",
                  folder_ / "scratch");
  ASSERT_EQ(ended.exit_code, 130) << ended.err;
  const auto read = [&](const char* name) {
    std::ifstream in(folder_ / name);
    return nlohmann::json::parse(in, nullptr, false);
  };
  nlohmann::json part = read("d/stability-part.json");
  ASSERT_GE(part["cells"].size(), 1u);
  part["cells"][0]["trials"] = 12345;  // is it counted again?
  write("d/stability-part.json", part.dump());
  const CommandResult other = run("chart --stability --quiet -o d");  // with all rays
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("--restart"), std::string::npos) << other.err;

  const CommandResult result = run("chart --stability --quick -o d");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("\n0 failures of the defaults\n"), std::string::npos) << result.out;
  for (const char* file : {"d/stability.md", "d/stability.csv"}) EXPECT_TRUE(exists(file)) << file;
  EXPECT_FALSE(exists("d/stability-part.json"));
  const nlohmann::json json = read("d/stability.json");
  ASSERT_TRUE(json.contains("rays") && json.contains("pictures"));
  EXPECT_EQ(json["rays"][0]["trials"], 12345);
  const auto fails = [](const nlohmann::json& cell) { return cell["failures"] != 0; };
  EXPECT_TRUE(std::any_of(json["rays"].begin(), json["rays"].end(), fails));  // of the cheaper methods
}

}  // namespace
}  // namespace pinocchio
