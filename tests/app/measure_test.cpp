#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "app/report/stats.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

class MeasureTest : public ProgramTest {
 protected:
  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return nlohmann::json::parse(in, nullptr, false);
  }
};

// One frame each 10 ms, delivered 30 ms after it began.
std::vector<FrameRecord> pipelined_records(std::size_t count) {
  std::vector<FrameRecord> records(count);
  for (std::size_t i = 0; i < count; ++i) records[i].frame = {0.01 * i, 0.01 * i + 0.03};
  return records;
}

TEST(Figures, PipelinedFramesASecondAreThoseDelivered) {
  const auto fps = [](const std::vector<FrameRecord>& records) {
    return app::figures(records, {}, {}, {8, 6}, nullptr)["fps"].get<double>();
  };
  EXPECT_NEAR(fps(pipelined_records(6)), 100.0, 1e-9);
  EXPECT_NEAR(fps(pipelined_records(2)), 100.0, 1e-9);
  EXPECT_NEAR(fps(pipelined_records(1)), 1.0 / 0.03, 1e-9);
  EXPECT_EQ(fps({}), 0.0);
  const nlohmann::json six = app::figures(pipelined_records(6), {}, {}, {8, 6}, nullptr);
  EXPECT_NEAR(six["frame"]["ms"]["p50"].get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(six["latency"]["ms"]["p50"].get<double>(), 30.0, 1e-9);
}

// Reprojected, the last frame's own mask and reflection are not traced: it sent nothing.
TEST(Figures, ReprojectedBytesAreThoseOfTracedFrames) {
  std::vector<FrameRecord> records = pipelined_records(4);
  for (std::size_t i = 0; i < 3; ++i) records[i][Channel::mask] = 1000, records[i].rays.primary = 48;
  Settings settings;
  settings.exchange = Exchange::reproject;
  const nlohmann::json reprojected = app::figures(records, settings, {}, {8, 6}, nullptr);
  EXPECT_EQ(reprojected["bytes"]["cpu_to_gpu"], 1000);
  EXPECT_EQ(reprojected["rays"]["primary"], 48);
  EXPECT_EQ(reprojected["frames"], 4);
  settings.exchange = Exchange::pipelined;
  EXPECT_EQ(app::figures(records, settings, {}, {8, 6}, nullptr)["bytes"]["cpu_to_gpu"], 750);
}

const std::string kSmallRun = "--size 80x60 --turntable 9 ";
const std::string kLarger = "--size 240x180 --turntable 9 ";  // that the rasteriser finds what is seen

TEST_F(MeasureTest, PrintsATableAndWritesTheFigures) {
  const CommandResult result = run("measure" + scene("cornell") + kLarger + "--stats-json m.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* word :
       {"frames/s", "p50", "trace_shadow", "bytes a frame", "latency 2 frames", "busy: GPU"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  EXPECT_EQ(result.out.find("at most"), std::string::npos) << result.out;
  const nlohmann::json figures = json("m.json");
  EXPECT_EQ(figures["size"], nlohmann::json({240, 180}));
  EXPECT_EQ(figures["latency"]["frames"], 2);
  EXPECT_GT(figures["exchange"]["gpu_to_cpu"]["ratio_to_memcpy"], 0.0);
  EXPECT_GT(figures["overlap"]["cpu_busy"], 0.0);
  EXPECT_LE(figures["overlap"]["both_busy"], figures["overlap"]["cpu_busy"]);
  EXPECT_EQ(figures["bytes"]["gpu_to_cpu"], 240 * 180 * 2);
}

TEST_F(MeasureTest, PrintsWhatTravelsAndTheBoundOnRequest) {
  const CommandResult result =
      run("measure" + scene("two-lights") + kLarger + "--bounds --stats-json m.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("at most"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("--plan slides"), std::string::npos) << result.out;
  const nlohmann::json bytes = json("m.json")["bytes"];
  const std::size_t all = result.out.find("\n  all ");
  ASSERT_NE(all, std::string::npos) << result.out;
  double to_cpu = 0.0, to_gpu = 0.0;
  std::istringstream(result.out.substr(all + 6)) >> to_cpu >> to_gpu;
  EXPECT_NEAR(to_cpu, bytes["gpu_to_cpu"].get<double>(), 0.5);
  EXPECT_NEAR(to_gpu, bytes["cpu_to_gpu"].get<double>(), 0.5);
}

// A path of one key: each frame is drawn, although none differs from the one before.
TEST_F(MeasureTest, EachFrameOfAStillCameraIsDrawn) {
  write("still.json", R"({"keyframes": [{"frame": 0, "eye": [0, 1, 3], "target": [0, 1, 0]}]})");
  const std::string measure =
      "measure" + scene("cornell") + "--size 240x180 --path still.json --quiet --stats-json m.json ";
  ASSERT_EQ(run(measure + "--frames 9").exit_code, 0);
  EXPECT_EQ(json("m.json")["frames"], 6);  // three warm up
  EXPECT_EQ(json("m.json")["bytes"]["gpu_to_cpu"], 240 * 180 * 2);
  ASSERT_EQ(run(measure + "--mode raytrace").exit_code, 0);  // the path's one frame
  EXPECT_EQ(json("m.json")["frames"], 1);
  EXPECT_EQ(json("m.json")["rays"]["primary"], 240 * 180);
}

// What the CPU draws alone keeps no GPU busy and sends nothing.
TEST_F(MeasureTest, ARaytracedFrameIsTheProcessorsAlone) {
  const CommandResult result =
      run("measure" + scene("cornell") + kSmallRun + "--mode raytrace --stats-json m.json --trace t.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("GPU"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("busy: CPU"), std::string::npos) << result.out;
  const nlohmann::json overlap = json("m.json")["overlap"];
  EXPECT_EQ(overlap["gpu_busy"], 0.0);
  EXPECT_EQ(overlap["both_busy"], 0.0);
  EXPECT_GT(overlap["cpu_busy"], 0.0);
  bool has_raster = false;
  std::set<std::string> rows;
  const nlohmann::json trace = json("t.json");
  for (const nlohmann::json& event : trace["traceEvents"]) {
    if (event["name"] == "raster") has_raster = true;
    if (event["name"] == "thread_name") rows.insert(event["args"]["name"].get<std::string>());
  }
  EXPECT_TRUE(has_raster);
  EXPECT_EQ(rows, std::set<std::string>{"CPU tracer"});
}

TEST_F(MeasureTest, ASingleNumberIsSoManyFrames) {
  const std::string measure =
      "measure" + scene("cornell") + "--size 40x30 --mode raytrace --stats-json m.json ";
  CommandResult result = run(measure + "--frames 10");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json("m.json")["frames"], 7);  // three warm up
  EXPECT_FALSE(json("m.json").contains("note"));
  result = run(measure + "--frames 4-6");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json("m.json")["frames"], 2);
  EXPECT_NE(result.out.find("figures of 2 frames say little"), std::string::npos) << result.out;
  EXPECT_TRUE(json("m.json").contains("note"));
  EXPECT_EQ(run(measure + "--frames 0").exit_code, 2);
}

// Figures are a picture's, whatever number of samples it takes.
TEST_F(MeasureTest, SamplesAreCountedInTheirPicture) {
  const std::string measure = "measure" + scene("cornell") +
                              "--size 40x30 --mode raytrace --frames 8 --stats-json m.json --trace t.json ";
  ASSERT_EQ(run(measure).exit_code, 0);
  const nlohmann::json one = json("m.json");
  // The noise is below 1 when it is first estimated, after 16 samples.
  for (const auto& [options, samples] : {std::pair("--spp 4", 4), std::pair("--spp 64 --max-noise 1", 16)}) {
    ASSERT_EQ(run(measure + options).exit_code, 0);
    const nlohmann::json several = json("m.json");
    EXPECT_EQ(several["frames"], one["frames"]) << options;
    EXPECT_EQ(several["rays"]["primary"], samples * one["rays"]["primary"].get<int>()) << options;
    int traced = 0;
    std::map<int, double> worked;  // milliseconds by picture, for all of its samples
    const nlohmann::json trace = json("t.json");
    for (const nlohmann::json& event : trace["traceEvents"]) {
      traced += event["name"] == "raster" ? 1 : 0;
      if (event["ph"] == "X")
        worked[event["args"]["frame"].get<int>() / samples] += event["dur"].get<double>() / 1e3;
    }
    EXPECT_EQ(traced, samples * one["frames"].get<int>()) << options;
    // Each picture's latency is at least the time of all its stages.
    std::vector<double> least;
    for (const auto& [picture, milliseconds] : worked) least.push_back(milliseconds);
    EXPECT_GT(several["latency"]["ms"]["p50"], app::percentiles(least)["p50"]) << options;
  }
}

TEST_F(MeasureTest, LibrariesAreNotSearchedForInEachFrame) {
  const auto searches = [this](const std::string& frames) {
    const CommandResult ran =
        run("measure" + scene("cornell") + "--size 40x30 --mode hybrid --frames " + frames, "LD_DEBUG=libs");
    EXPECT_EQ(ran.exit_code, 0);
    const std::string searched = "find library=";  // what the dynamic loader prints
    int count = 0;
    for (std::size_t at = ran.err.find(searched); at != std::string::npos;
         at = ran.err.find(searched, at + 1))
      ++count;
    return count;
  };
  const int of_few = searches("4");
  EXPECT_GT(of_few, 0);
  EXPECT_EQ(searches("12"), of_few);
}

TEST_F(MeasureTest, TheProcessorIsNotBusyForLongerThanTheRun) {
  ASSERT_EQ(
      run("measure" + scene("windmill.glb") + "--size 64x48 --frames 5-9 --mode raytrace --stats-json m.json")
          .exit_code,
      0);
  EXPECT_LE(json("m.json")["overlap"]["cpu_busy"], 1.0 + 1e-9);
}

TEST_F(MeasureTest, RefusesMoreFramesThanItKeepsFiguresOf) {
  const CommandResult result =
      run("measure" + scene("cornell") + "--size 8x6 --mode raytrace --frames 0-2000000000");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("2000000001 frames are more than measure keeps figures of (100000)"),
            std::string::npos)
      << result.err;
}

TEST_F(MeasureTest, ComparesDesignsAndExchangesInOneRun) {
  const CommandResult result =
      run("measure" + scene("cornell") + kSmallRun + "--compare --stats-json m.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> names;
  const nlohmann::json figures = json("m.json");
  for (const nlohmann::json& one : figures["runs"]) names.insert(one["name"].get<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"design 1 sync", "design 1 pipelined", "design 1 reproject",
                                          "design 2 sync", "design 2 pipelined", "raytrace", "raster"}));
  for (const std::string& name : names) EXPECT_NE(result.out.find(name), std::string::npos) << name;
  EXPECT_EQ(run("measure" + scene("cornell") + kSmallRun + "--compare --tiles").exit_code, 2);
}

TEST_F(MeasureTest, SlidesMoveTheirBytesAtTheirSize) {
  const struct {
    const char* design;
    int to_cpu, to_gpu;
  } kWanted[] = {{"1", 2'880'000, 1'920'000},
                 {"1 --exchange reproject", 2'880'000, 1'920'000},
                 {"2", 9'120'000, 1'440'000}};
  for (const auto& wanted : kWanted) {
    const CommandResult result =
        run("measure" + scene("cornell") +
            "--turntable 4 --plan slides --quiet --stats-json m.json --design " + wanted.design);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json("m.json")["bytes"]["gpu_to_cpu"], wanted.to_cpu) << wanted.design;
    EXPECT_EQ(json("m.json")["bytes"]["cpu_to_gpu"], wanted.to_gpu) << wanted.design;
  }
}

// Perfetto's rule: slices of a thread, which are counted in whole nanoseconds, do not overlap.
TEST_F(MeasureTest, TraceIsChromesFormatWithoutSlicesThatOverlap) {
  for (const std::string more :
       {"", "--exchange sync", "--exchange reproject", "--design 2", "--mode raytrace"}) {
    EXPECT_EQ(run("measure" + scene("cornell") + kSmallRun + "--quiet --trace t.json " + more).exit_code, 0);
    const nlohmann::json trace = json("t.json");
    std::set<std::string> phases;
    std::set<int> named;
    std::map<int, std::vector<std::pair<long long, long long>>> threads;
    const auto ns = [](const nlohmann::json& us) { return std::llround(1e3 * us.get<double>()); };
    for (const nlohmann::json& event : trace["traceEvents"]) {
      phases.insert(event["ph"].get<std::string>());
      if (event["ph"] == "M") named.insert(event["tid"].get<int>());
      if (event["ph"] == "X")
        threads[event["tid"].get<int>()].emplace_back(ns(event["ts"]), ns(event["ts"]) + ns(event["dur"]));
    }
    if (more.empty()) {
      EXPECT_EQ(phases, (std::set<std::string>{"M", "X", "s", "t", "f"}));
    }
    for (auto& [thread, slices] : threads) {
      EXPECT_TRUE(named.contains(thread)) << thread;
      std::ranges::sort(slices);
      for (std::size_t i = 1; i < slices.size(); ++i)
        EXPECT_GE(slices[i].first, slices[i - 1].second) << more << " thread " << thread;
    }
  }
}

TEST_F(MeasureTest, ABudgetIsMeasuredKeptAndReported) {
  // Large enough that which plan is faster is no matter of what runs beside it.
  const CommandResult result =
      run("measure" + scene("two-lights") +
          "--size 320x240 --turntable 9 --max-error FLIP=0.05 --budget 10s --stats-json m.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("kept by 9 of 9 frames"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("from frame 0: "), std::string::npos) << result.out;
  const nlohmann::json budget = json("m.json")["budget"];
  EXPECT_EQ(budget["frames"], 9);
  EXPECT_EQ(budget["metric"], "flip");
  EXPECT_GE(budget["front"].size(), 2u);
  EXPECT_EQ(budget["front"][0]["error"], 0.0);
  for (std::size_t i = 1; i < budget["front"].size(); ++i) {
    EXPECT_GT(budget["front"][i]["error"], budget["front"][i - 1]["error"]);
    EXPECT_LT(budget["front"][i]["frame_ms"], budget["front"][i - 1]["frame_ms"]);
  }
  EXPECT_EQ(budget["used"][0]["error"], 0.0);  // ten seconds are enough for the exact plan
  EXPECT_EQ(run("measure" + scene("cornell") + kSmallRun + "--budget soon").exit_code, 2);
  EXPECT_EQ(run("measure" + scene("cornell") + kSmallRun + "--max-error flop=1").exit_code, 2);
  EXPECT_EQ(run("measure" + scene("cornell") + kSmallRun + "--budget 9ms --mode raytrace").exit_code, 2);
}

TEST_F(MeasureTest, AWrittenPlanIsGivenBack) {
  const CommandResult written = run("info --plan --json" + scene("two-lights"));
  EXPECT_EQ(written.exit_code, 0) << written.err;
  nlohmann::json plan = nlohmann::json::parse(written.out);
  plan["plan"]["reflection_scale"] = 2;
  std::ofstream(folder_ / "plan.json") << plan.dump(2);
  const CommandResult result =
      run("measure" + scene("two-lights") + kSmallRun + "--plan plan.json --quiet --stats-json m.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json drawn = json("m.json")["plan"];
  for (const auto& [name, value] : plan["plan"].items()) EXPECT_EQ(drawn[name], value) << name;
  const std::string measure = "measure" + scene("two-lights") + kSmallRun;
  EXPECT_EQ(run(measure + "--plan plan.json --depth 2 --quiet --stats-json m.json").exit_code, 0);
  EXPECT_EQ(json("m.json")["plan"]["depth"], 2);  // an option overrides the file
  EXPECT_EQ(run(measure + "--plan none.json").exit_code, 2);
  EXPECT_EQ(run(measure + "--plan plan.json --compare").exit_code, 2);
  std::ofstream(folder_ / "plan.json") << "{\n  \"mask_bits\": 3\n}";
  EXPECT_NE(run(measure + "--plan plan.json")
                .err.find("plan.json:2: mask_bits is 3; it is 0, 1, 2, 4, 8, 16, 32 or 64"),
            std::string::npos);
}

}  // namespace
}  // namespace pinocchio
