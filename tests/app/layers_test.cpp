// Includes run one way: app -> hybrid -> {core, gl}; core and gl see nothing of each other but the family of
// errors, and within core a
// room sees only rooms below it. The laboratory (bench, scenes/generator) sees the libraries, which do not
// see it, nor does the program but for the verbs that run it. The Python module sees public headers alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

using Rooms = std::map<std::string, std::set<std::string>>;

// What each room may include beside itself.
const Rooms kMaySee{{"core", {"shaders"}},
                    {"gl", {}},
                    {"hybrid", {"core", "gl"}},
                    {"app", {"core", "gl", "hybrid", "bench", "scenes"}},
                    {"python", {}},
                    {"scenes", {"core"}},
                    {"bench", {"core", "gl", "hybrid", "scenes"}}};
// The family of errors, which each room throws of.
const std::set<std::string> kErrors{"core/base/error.h", "core/base/open_gl_error.h"};
// Who of the program may see the laboratory.
const std::set<std::string> kLaboratory{"bench", "scenes"}, kLaboratoryVerbs{"chart.cpp", "generate.cpp"};
const Rooms kMaySeeInBench{{"chart", {}}, {"rays", {}}, {"stability", {}}};
const Rooms kMaySeeInCore{{"base", {}},
                          {"math", {}},
                          {"simd", {}},
                          {"parallel", {"base", "math"}},
                          {"image", {"base", "math", "parallel"}},
                          {"compare", {"base", "math", "image", "parallel"}},
                          {"scene", {"base", "math", "image", "parallel"}},
                          {"bsp", {"base", "math", "parallel", "scene"}},
                          {"trace", {"base", "math", "image", "scene", "bsp", "simd", "parallel"}},
                          {"reference", {"base", "math", "image", "scene", "parallel", "trace"}},
                          {"output", {"base", "math", "image", "scene", "parallel", "trace"}}};

// Where core's public headers belong; those of hybrid are not named here.
const std::map<std::string, std::string> kRoomOfPublic{
    {"error.h", "base"},          {"open_gl_error.h", "base"},
    {"progress.h", "base"},       {"names.h", "base"},
    {"glm_layout.h", "math"},     {"bounds.h", "math"},
    {"pixel_box.h", "math"},      {"ray.h", "math"},
    {"image.h", "image"},         {"mask_image.h", "image"},
    {"exr.h", "image"},           {"pixel_memory.h", "image"},
    {"camera.h", "scene"},        {"light.h", "scene"},
    {"load.h", "scene"},          {"material.h", "scene"},
    {"material_maps.h", "scene"}, {"texture.h", "scene"},
    {"animation.h", "scene"},     {"deformation.h", "scene"},
    {"environment.h", "scene"},   {"terminator.h", "trace"},
    {"threads.h", "parallel"},    {"mesh.h", "scene"},
    {"nodes.h", "scene"},         {"save.h", "scene"},
    {"scene.h", "scene"},         {"build_options.h", "bsp"},
    {"triangle_test.h", "bsp"},   {"ray_counts.h", "trace"},
    {"ray_offset.h", "trace"},    {"tracer.h", "trace"},
    {"view.h", "trace"},          {"compare_pictures.h", "compare"},
    {"frame_arrays.h", "trace"},  {"surface_images.h", "trace"}};

// A public header as if it stood in its room: "pinocchio/tracer.h" is "core/trace/tracer.h".
std::string in_its_room(const std::string& include) {
  const std::string kPublic = "pinocchio/";
  if (include.rfind(kPublic, 0) != 0) return include;
  const std::string name = include.substr(kPublic.size());
  const auto room = kRoomOfPublic.find(name);
  return room == kRoomOfPublic.end() ? "hybrid/" + name : "core/" + room->second + "/" + name;
}

std::vector<std::string> includes_of(const std::filesystem::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    constexpr std::string_view kInclude = "#include \"";
    if (line.rfind(kInclude, 0) == 0)
      found.push_back(in_its_room(line.substr(kInclude.size(), line.rfind('"') - kInclude.size())));
  }
  return found;
}

bool is_source(const std::filesystem::path& file) {
  return file.extension() == ".h" || file.extension() == ".cpp";
}

// "file includes what" for every include that no rule allows. Rooms are folders of `root`; includes
// begin with `prefix`.
std::vector<std::string> violations(const std::filesystem::path& root, const std::string& prefix,
                                    const Rooms& may_see) {
  std::vector<std::string> found;
  for (const auto& [room, others] : may_see) {
    if (!std::filesystem::exists(root / room)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room)) {
      if (!is_source(entry.path())) continue;
      for (const std::string& include : includes_of(entry.path())) {
        if (include.rfind(prefix, 0) != 0) continue;
        const std::string rest = include.substr(prefix.size());
        const std::string other = rest.substr(0, rest.find('/'));
        if (other != room && !others.count(other) && !kErrors.count(include))
          found.push_back(entry.path().string() + " includes " + include);
      }
    }
  }
  return found;
}

TEST(Layers, IncludesRunOneWay) {
  for (const std::string& violation : violations(PINOCCHIO_SOURCE_DIR, "", kMaySee))
    ADD_FAILURE() << violation;
}

TEST(Layers, WithinCoreToo) {
  const std::filesystem::path core = std::filesystem::path(PINOCCHIO_SOURCE_DIR) / "core";
  for (const std::string& violation : violations(core, "core/", kMaySeeInCore)) ADD_FAILURE() << violation;
  for (const auto& entry : std::filesystem::directory_iterator(core)) {
    if (entry.is_directory() && entry.path().filename() != "include") {
      EXPECT_TRUE(kMaySeeInCore.count(entry.path().filename().string())) << entry.path() << " has no rule";
    }
  }
}

// They see public headers alone; core's, those of rooms that their own may see.
TEST(Layers, PublicHeadersToo) {
  const std::filesystem::path root(PINOCCHIO_SOURCE_DIR);
  std::size_t of_core = 0;
  for (const char* library : {"core", "hybrid"})
    for (const auto& entry : std::filesystem::directory_iterator(root / library / "include/pinocchio")) {
      const std::string name = entry.path().filename().string();
      const auto room = kRoomOfPublic.find(name);
      EXPECT_EQ(room != kRoomOfPublic.end(), library == std::string("core")) << name;
      of_core += room != kRoomOfPublic.end() ? 1 : 0;
      for (const std::string& include : includes_of(entry.path())) {
        EXPECT_TRUE(kRoomOfPublic.count(std::filesystem::path(include).filename().string()) ||
                    std::filesystem::exists(root / "hybrid/include/pinocchio" /
                                            std::filesystem::path(include).filename()))
            << name << " includes " << include;
        if (room == kRoomOfPublic.end()) continue;
        const std::string other = std::filesystem::path(include).parent_path().filename().string();
        EXPECT_TRUE(other == room->second || kMaySeeInCore.at(room->second).count(other))
            << name << " includes " << include;
      }
    }
  EXPECT_EQ(of_core, kRoomOfPublic.size());
}

TEST(Layers, TheLaboratoryIsApart) {
  const std::filesystem::path root(PINOCCHIO_SOURCE_DIR);
  for (const std::string& violation : violations(root / "bench", "bench/", kMaySeeInBench))
    ADD_FAILURE() << violation;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "app")) {
    if (!is_source(entry.path()) || kLaboratoryVerbs.count(entry.path().filename().string())) continue;
    for (const std::string& include : includes_of(entry.path()))
      EXPECT_FALSE(kLaboratory.count(include.substr(0, include.find('/'))))
          << entry.path() << " includes " << include;
  }
}

// How the engine is made inside is not the program's.
TEST(Layers, TheProgramDoesNotSeeTheEnginesParts) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(PINOCCHIO_SOURCE_DIR "/app")) {
    if (!is_source(entry.path())) continue;
    for (const std::string& include : includes_of(entry.path())) {
      EXPECT_NE(include, "hybrid/engine_parts.h") << entry.path();
      EXPECT_NE(include, "hybrid/frame_slot.h") << entry.path();
      EXPECT_NE(include.substr(0, include.rfind('/') + 1), "hybrid/gpu/")
          << entry.path() << " includes " << include;
      EXPECT_NE(include.substr(0, include.rfind('/') + 1), "hybrid/passes/")
          << entry.path() << " includes " << include;
    }
  }
}

TEST(Layers, GlCallsLiveInGlAlone) {
  const std::filesystem::path root(PINOCCHIO_SOURCE_DIR);
  const std::regex kCall(R"(\bgl[A-Z]\w*\()");
  for (const char* room : {"core", "hybrid", "app", "bench", "scenes"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room)) {
      if (!is_source(entry.path())) continue;
      std::ifstream in(entry.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      std::smatch call;
      EXPECT_FALSE(std::regex_search(text, call, kCall)) << entry.path() << " calls " << call.str();
    }
}

TEST(Layers, AViolationIsFound) {
  const std::filesystem::path root = own_folder() / "layers";
  std::filesystem::create_directories(root / "core/math");
  std::filesystem::create_directories(root / "gl");
  std::filesystem::create_directories(root / "hybrid");
  std::ofstream(root / "core/math/bad.h") << "#pragma once\n#include \"gl/context.h\"\n";
  std::ofstream(root / "gl/bad.cpp") << "#include \"core/math/finite.h\"\n#include \"gl/good.h\"\n";
  std::ofstream(root / "core/math/worse.h") << "#include \"scenes/generator/random.h\"\n";
  std::ofstream(root / "hybrid/bad.cpp") << "#include \"bench/stability/table.h\"\n";
  EXPECT_EQ(violations(root, "", kMaySee).size(), 4u);
  std::filesystem::remove_all(root);
}

}  // namespace
}  // namespace pinocchio
