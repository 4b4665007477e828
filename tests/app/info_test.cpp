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
