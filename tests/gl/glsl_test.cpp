// Every shader by the reference compiler of GLSL: what only one driver forgives is an error there. Mesa takes
// more than the language is, other drivers take less.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "gl/objects/shader_source.h"
#include "tests/support/command.h"
#include "tests/support/own_file.h"
#include "tests/support/source_path.h"

namespace pinocchio {
namespace {

using Definitions = std::vector<std::string>;

Definitions joined(std::initializer_list<Definitions> all) {
  Definitions together;
  for (const Definitions& one : all) together.insert(together.end(), one.begin(), one.end());
  return together;
}

// What a pass may be compiled with (hybrid/gpu, hybrid/inspect), by what it depends on.
const std::vector<Definitions> kIds{{"ID_BITS 16"}, {"ID_BITS 24"}, {"ID_BITS 32"}};
const std::vector<Definitions> kTerminators{{}, {"TERMINATOR_LIFTS"}, {"TERMINATOR_SMOOTHS"}};
const std::vector<Definitions> kMaps{{},
                                     {"HAS_MAPS", "MAP_USES 0"},
                                     {"HAS_MAPS", "MAP_USES 32895"},
                                     {"HAS_MAPS", "MAP_USES 8128", "HAS_COLORS"},
                                     {"HAS_MAPS", "MAP_USES 16415", "HAS_TANGENTS"},
                                     {"HAS_MAPS", "MAP_USES 65535", "HAS_COLORS", "HAS_TANGENTS"}};
const std::vector<Definitions> kLights{{},
                                       {"HAS_SIZED_LIGHTS"},
                                       {"FREE_LIGHTS_ONLY"},
                                       {"HAS_ENVIRONMENT"},
                                       {"HAS_SIZED_LIGHTS", "FREE_LIGHTS_ONLY", "HAS_ENVIRONMENT"}};
const std::vector<Definitions> kTraced{
    {},
    {"HAS_MASK", "MASK_BITS 1", "MASK_SCALE 1"},
    {"HAS_MASK", "MASK_BITS 8", "MASK_SCALE 4"},
    {"HAS_MASK", "MASK_BITS 16", "MASK_SCALE 1"},
    {"HAS_MASK", "MASK_BITS 64", "MASK_SCALE 2", "LIGHTS_IN_REFLECTION"},
    {"HAS_REFLECTION", "REFLECTION_SCALE 1", "REFLECTION_TEXELS 1", "REFLECTION_TILE 8"},
    {"HAS_MASK", "MASK_BITS 2", "MASK_SCALE 2", "HAS_REFLECTION", "REFLECTION_SCALE 2", "REFLECTION_TEXELS 3",
     "REFLECTION_IS_SRGB"},
    {"HAS_MASK", "MASK_BITS 4", "MASK_SCALE 1", "HAS_REFLECTION", "REFLECTION_SCALE 4", "REFLECTION_TEXELS 1",
     "REFLECTION_IS_SRGB", "REFLECTION_TILE 8", "REPROJECT"},
    {"HAS_MASK", "MASK_BITS 4", "MASK_SCALE 4", "HAS_REFLECTION", "REFLECTION_SCALE 1", "REFLECTION_TEXELS 3",
     "REFLECTION_TILE 8", "REPROJECT"}};
const std::vector<Definitions> kShown{{},
                                      {"SHOW_IDS"},
                                      {"SHOW_NORMALS"},
                                      {"SHOW_MASK"},
                                      {"SHOW_REFLECTION"},
                                      {"SHOW_DELAY"},
                                      {"SHOW_DEPTH"},
                                      {"SHOW_POSITION"},
                                      {"SHOW_ALBEDO"}};

class GlslTest : public testing::Test {
 protected:
  void SetUp() override {
    if (run_command("glslangValidator --version", own_folder()).exit_code != 0)
      GTEST_SKIP() << "glslangValidator is missing (Debian's package glslang-tools)";
  }

  void add(const std::string& file, const Definitions& definitions) {
    const std::string kind = std::filesystem::path(file).extension().string();
    const std::filesystem::path to = own_file(std::to_string(count_++) + kind);
    std::ofstream(to)
        << gl::assemble_shader(gl::ShaderSource(source_path("shaders")), file, definitions).text;
    what_ += to.filename().string() + ": " + file;
    for (const std::string& definition : definitions) what_ += ", " + definition;
    what_ += "\n";
  }

  void compile() const {
    const CommandResult result =
        run_command("cd '" + own_folder().string() + "' && glslangValidator *.vert *.frag", own_folder());
    EXPECT_TRUE(result.exit_code == 0 && result.out.find("WARNING:") == std::string::npos)
        << result.out.substr(0, 4000) << what_.substr(0, 4000);
  }

  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::string what_;
};

TEST_F(GlslTest, EveryVariantIsGlslToTheLetter) {
  std::size_t turn = 0;
  const auto ids = [&turn]() -> const Definitions& { return kIds[turn++ % kIds.size()]; };
  const auto terminator = [&turn]() -> const Definitions& {
    return kTerminators[turn / kIds.size() % kTerminators.size()];
  };
  for (const Definitions& maps : kMaps) {
    for (const Definitions& traced : kTraced)
      for (const Definitions& lights : kLights)
        add("composite.frag", joined({ids(), terminator(), maps, traced, lights}));
    for (const Definitions& bits : kIds)
      for (const Definitions& normals : {Definitions{}, Definitions{"NORMALS_ONLY"}})
        add("gbuffer.frag", joined({bits, terminator(), maps, normals}));
  }
  for (const Definitions& traced : kTraced)
    for (const Definitions& shown : kShown) {
      const auto has = [&traced = traced](const char* what) { return std::ranges::count(traced, what) > 0; };
      if (shown == Definitions{"SHOW_MASK"} && !has("HAS_MASK")) continue;
      if (shown == Definitions{"SHOW_REFLECTION"} && !has("HAS_REFLECTION")) continue;
      add("inspect.frag", joined({ids(), terminator(), traced, shown}));
    }
  for (const Definitions& bits : kIds) {
    for (const char* texels : {"FINISHED_TEXELS 1", "FINISHED_TEXELS 3"})
      add("show.frag", joined({bits, {texels}}));
    add("visibility.vert", bits);
    for (const Definitions& backs : {Definitions{}, Definitions{"PASSES_BACKS"}}) {
      add("visibility.frag", joined({bits, backs}));
      for (const Definitions& maps : kMaps)
        if (!maps.empty()) add("visibility.frag", joined({bits, backs, {"HAS_HOLES"}, maps}));
    }
  }
  for (const char* file : {"accumulate.frag", "present.frag", "light.frag", "fullscreen.vert"}) add(file, {});
  EXPECT_GT(count(), 300u);
  compile();
}

}  // namespace
}  // namespace pinocchio
