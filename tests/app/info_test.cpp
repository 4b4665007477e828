#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pinocchio/frame_arrays.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

using InfoTest = ProgramTest;

TEST_F(InfoTest, SystemListsWhatWasTriedAndWhyItFailed) {
  const CommandResult result = run("info --system");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("OSMesa"), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(run("info --system --json").out);
  EXPECT_FALSE(json["contexts"].empty());
  for (const nlohmann::json& context : json["contexts"])
    EXPECT_TRUE(context["works"].get<bool>() ? context.contains("renderer") : context.contains("failure"));
}

// Whatever a driver does, the list is whole: zink crashes OSMesa, softpipe draws nothing.
TEST_F(InfoTest, SystemOutlivesDriversThatCrash) {
  for (const char* driver : {"GALLIUM_DRIVER=zink", "LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=zink",
                             "MESA_LOADER_DRIVER_OVERRIDE=zink", "GALLIUM_DRIVER=softpipe"}) {
    const CommandResult result = run("info --system --json", driver);
    ASSERT_EQ(result.exit_code, 0) << driver;
    const nlohmann::json contexts = nlohmann::json::parse(result.out)["contexts"];
    ASSERT_GE(contexts.size(), 3u) << driver;
    const auto osmesa = std::ranges::find(contexts, "OSMesa", [](const auto& c) { return c["tried"]; });
    ASSERT_NE(osmesa, contexts.end()) << driver;
    const std::string failure = osmesa->value("failure", "");
    if (std::string(driver).find("GALLIUM_DRIVER=zink") != std::string::npos) {
      EXPECT_NE(failure.find("GALLIUM_DRIVER=zink"), std::string::npos) << failure;
    }
    if (std::string(driver).find("softpipe") != std::string::npos) {
      EXPECT_NE(failure.find("draws nothing"), std::string::npos) << failure;
    }
  }
}

TEST_F(InfoTest, SceneIsDescribed) {
  const CommandResult result = run("info" + scene("two-lights"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("light 'key', casts shadows"), std::string::npos) << result.out;
  const nlohmann::json json = nlohmann::json::parse(run("info --json" + scene("two-lights")).out);
  EXPECT_EQ(json["needs"]["casting_lights"], 1);
  EXPECT_EQ(json["needs"]["reflection"], true);
}

TEST_F(InfoTest, PlanIsExplainedALineAChoice) {
  const CommandResult result = run("info --plan" + scene("two-lights"));
  EXPECT_EQ(result.exit_code, 0);
  for (const char* words :
       {"ids of 16 bits", "shadow mask of 1 bit a pixel: 1 light casts", "8 bounces: as many as requested"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const nlohmann::json json = nlohmann::json::parse(run("info --plan --json --studio off t.obj").out);
  EXPECT_EQ(json["plan"]["mask_bits"], 1);  // of the default light, as the verbs that draw give it
  EXPECT_EQ(json["plan"]["reflection"], "none");
  EXPECT_FALSE(json["why"].empty());
}

// A triangle under point lights.
std::string triangle_under(int lights) {
  nlohmann::json json = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
    "buffers": [{"byteLength": 36, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0
  })");
  for (int i = 0; i < lights; ++i) {
    json["extensions"]["KHR_lights_punctual"]["lights"].push_back(
        {{"type", "point"}, {"name", "lamp " + std::to_string(i)}, {"intensity", 1}});
    json["nodes"].push_back(
        {{"translation", {0.1 * i, 0.5, 2.0}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    json["scenes"][0]["nodes"].push_back(i + 1);
  }
  return json.dump();
}

// What more than eight lights cost, where a person asks.
TEST_F(InfoTest, ManyLightsAndWhatTheyCost) {
  write("few.gltf", triangle_under(8));
  write("forty.gltf", triangle_under(40));
  write("hundred.gltf", triangle_under(100));
  EXPECT_NE(run("info few.gltf")
                .out.find("8 of 8 lights cast shadows: as many shadow rays at each point, 1 "
                          "byte a pixel of shadow mask"),
            std::string::npos);
  const CommandResult forty = run("info --plan forty.gltf"), hundred = run("info --plan hundred.gltf");
  EXPECT_NE(forty.out.find("8 bytes a pixel of shadow mask; 0 reach nothing"), std::string::npos)
      << forty.out;
  EXPECT_NE(forty.out.find("shadow mask of 64 bits a pixel, 8 bytes to the GPU: 40 lights cast"),
            std::string::npos)
      << forty.out;
  EXPECT_NE(hundred.out.find("and the light of 36 with mirrored light"), std::string::npos) << hundred.out;
  EXPECT_NE(hundred.out.find("the CPU shades 36 of them, whose light travels with mirrored light"),
            std::string::npos)
      << hundred.out;
  EXPECT_EQ(nlohmann::json::parse(run("info --json forty.gltf").out)["needs"]["mask_bits"], 64);
}

// OpenEXR's own tools read the channels and the list of lights.
TEST_F(InfoTest, OpenExrsToolsReadTheMaskOfManyLights) {
  if (std::system("command -v exrheader > /dev/null") != 0) GTEST_SKIP() << "exrheader is not installed";
  write("forty.gltf", triangle_under(40));
  for (const char* mode : {"hybrid", "raytrace"}) {
    ASSERT_EQ(
        run("render forty.gltf --size 40x30 --quiet -o forty.exr --mode " + std::string(mode)).exit_code, 0);
    const CommandResult header =
        run_command("exrheader " + (folder_ / "forty.exr").string(), folder_ / "scratch");
    EXPECT_EQ(header.exit_code, 0);
    for (const char* words :
         {"shadow.mask, 32-bit unsigned integer", "shadow.mask1, 32-bit unsigned integer", "lamp 39"})
      EXPECT_NE(header.out.find(words), std::string::npos) << words << "\n" << header.out;
    EXPECT_EQ(header.out.find("shadow.mask2"), std::string::npos);
  }
}

// The slides' bytes are fixed: the picture is whole, and what it loses is said.
TEST_F(InfoTest, TheSlidesPlanSaysWhereMoreThanEightLightsTravel) {
  write("forty.gltf", triangle_under(40));
  const CommandResult slides = run("render forty.gltf --size 40x30 --plan slides -o slides.exr");
  EXPECT_EQ(slides.exit_code, 0) << slides.err;
  EXPECT_NE(slides.err.find("mask_bits 8: the light of the other 32 lights travels with mirrored light"),
            std::string::npos)
      << slides.err;
  const CommandResult refused =
      run("render forty.gltf --size 40x30 --mask-bits 8 --design 1 --reflection none -o x.exr");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.err.find("mask_bits 8 cannot hold the scene's 40 casting lights"), std::string::npos)
      << refused.err;
}

// Every OBJ is a scene without lights; written without the default light, its plan had no shadows.
TEST_F(InfoTest, APlanOfASceneWithoutLightsKeepsItsShadows) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv -1 -1 -1\nv 2 -1 -1\nv 0 2 -1\nf 4 5 6\n");
  write("plan.json", run("info --plan --json t.obj").out);
  const std::string small = " t.obj --size 40x30 --quiet -o ";
  ASSERT_EQ(run("render" + small + "auto.exr").exit_code, 0);
  ASSERT_EQ(run("render --plan plan.json" + small + "plan.exr").exit_code, 0);
  EXPECT_EQ(run("compare auto.exr plan.exr --channels --max-error max=0 --max-error mask=0").exit_code, 0);
  write("none.json", R"({"mask_bits": 0})");
  const CommandResult without = run("render --plan none.json t.obj --size 40x30 -o none.exr");
  EXPECT_EQ(without.exit_code, 0);
  EXPECT_NE(without.err.find("the shadows of 1 light(s) are left out"), std::string::npos) << without.err;
}

TEST_F(InfoTest, ThePageOfSettingsIsTheTable) {
  std::ifstream file(PINOCCHIO_SOURCE_DIR "/docs/settings.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  const CommandResult tables = run("info --settings");
  EXPECT_EQ(tables.exit_code, 0);
  EXPECT_EQ(page.substr(std::min(page.find("| setting |"), page.size())), tables.out)
      << "put what 'pinocchio info --settings' prints under the introduction of docs/settings.md";
}

TEST_F(InfoTest, HelpNamesUnitsAndVersionIsTold) {
  EXPECT_EQ(run("--version").exit_code, 0);
  const CommandResult help = run("render --help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"degrees", "pixels", "stops", "--size", "--backend"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  for (const LayerRow& row : kLayers)
    EXPECT_NE(help.out.find(row.exr.name), std::string::npos) << row.exr.name;
}

}  // namespace
}  // namespace pinocchio
