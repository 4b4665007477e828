// Includes run one way: app -> hybrid -> {core, gl}. core and gl share only the errors. The laboratory
// (bench, scenes/generator) sees the libraries; the libraries do not see it, and of the program only the
// verbs that run it do. The Python module sees only public headers. A room is a folder: rooms are read from
// the tree, and no two rooms include each other, directly or through others.
#include <gtest/gtest.h>

#include <algorithm>
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

namespace fs = std::filesystem;

// The floors, and which others each may include.
const std::map<std::string, std::set<std::string>> kMaySee{
    {"core", {"shaders"}},
    {"gl", {}},
    {"hybrid", {"core", "gl"}},
    {"app", {"core", "gl", "hybrid", "bench", "scenes"}},
    {"python", {}},
    {"scenes", {"core"}},
    {"bench", {"core", "gl", "hybrid", "scenes", "shaders"}}};
const std::set<std::string> kErrors{"pinocchio/error.h", "pinocchio/open_gl_error.h"};
// The only files of the program that may see the laboratory.
const std::set<std::string> kLaboratory{"bench", "scenes"}, kLaboratoryVerbs{"chart.cpp", "generate.cpp"};
// The engine's inside, which the program does not see.
const std::set<std::string> kOfTheEngine{"hybrid/engine", "hybrid/gpu", "hybrid/passes"};
constexpr std::ptrdiff_t kMostFiles = 24;  // in a folder of sources

struct Include {
  std::string from, what;  // the file, and the path that it includes
  [[nodiscard]] std::string text() const { return from + " includes " + what; }
};

bool is_source(const fs::path& file) {
  return file.extension() == ".h" || file.extension() == ".cpp";
}

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> found;
  if (fs::exists(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (is_source(entry.path())) found.push_back(entry.path());
  return found;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Include> includes_of(const fs::path& root, const fs::path& file) {
  static const std::regex kInclude("(^|\n)#include \"([^\"]+)\"");
  const std::string text = text_of(file);
  std::vector<Include> found;
  for (std::sregex_iterator at(text.begin(), text.end(), kInclude), end; at != end; ++at)
    found.push_back({fs::relative(file, root).string(), (*at)[2]});
  return found;
}

// The folders of "include/pinocchio".
const std::vector<std::string> kLibraries{"core", "core/compare", "hybrid"};

// "core/trace/walk"; the public headers of a library are a room, too.
std::string room_of(const fs::path& root, const std::string& include) {
  if (!include.starts_with("pinocchio/")) return fs::path(include).parent_path().string();
  for (const std::string& library : kLibraries)
    if (fs::exists(root / library / "include" / include)) return library + "/include/pinocchio";
  return {};
}

std::string floor_of(const std::string& room) {
  return room.substr(0, room.find('/'));
}

std::vector<std::string> floors_that_see_too_much(const fs::path& root) {
  std::vector<std::string> found;
  for (const auto& [floor, others] : kMaySee)
    for (const fs::path& file : sources(root / floor))
      for (const Include& include : includes_of(root, file)) {
        const std::string other = floor_of(room_of(root, include.what));
        const bool is_public = include.what.starts_with("pinocchio/");
        const bool may = other == floor || others.count(other) || kErrors.count(include.what) ||
                         (floor == "python" && is_public) || (floor == "gl" && other.empty());
        if (!other.empty() && !may) found.push_back(include.text());
      }
  return found;
}

// One line for each circle of rooms: an include of each step.
class Circles {
 public:
  explicit Circles(const fs::path& root) {
    for (const auto& [floor, others] : kMaySee)
      for (const fs::path& file : sources(root / floor)) {
        const std::string room = fs::relative(file, root).parent_path().string();
        for (const Include& include : includes_of(root, file)) {
          const std::string other = room_of(root, include.what);
          if (!other.empty() && other != room) steps_[room].emplace(other, include.text());
        }
      }
    for (const auto& [room, steps] : steps_) visit(room);
  }
  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }

 private:
  void visit(const std::string& room) {
    if (const auto begun = std::ranges::find(way_, room); begun != way_.end()) {
      std::string circle;
      for (auto at = begun; at != way_.end(); ++at)
        circle += steps_[*at].at(std::next(at) == way_.end() ? room : *std::next(at)) + "\n";
      found_.push_back(circle);
      return;
    }
    if (!done_.insert(room).second) return;
    way_.push_back(room);
    if (const auto steps = steps_.find(room); steps != steps_.end())
      for (const auto& [other, example] : steps->second) visit(other);
    way_.pop_back();
  }

  std::map<std::string, std::map<std::string, std::string>> steps_;
  std::vector<std::string> way_, found_;
  std::set<std::string> done_;
};

const fs::path kRoot = PINOCCHIO_SOURCE_DIR;

TEST(Layers, IncludesRunOneWay) {
  for (const std::string& violation : floors_that_see_too_much(kRoot)) ADD_FAILURE() << violation;
}

TEST(Layers, NoRoomsIncludeEachOther) {
  const Circles circles(kRoot);
  for (const std::string& circle : circles.found()) ADD_FAILURE() << circle;
}

TEST(Layers, PublicHeadersSeePublicHeadersAlone) {
  for (const std::string& library : kLibraries)
    for (const fs::path& file : sources(kRoot / library / "include"))
      for (const Include& include : includes_of(kRoot, file)) {
        EXPECT_TRUE(include.what.starts_with("pinocchio/")) << include.text();
        EXPECT_FALSE(library != "hybrid" && floor_of(room_of(kRoot, include.what)) == "hybrid")
            << include.text();
      }
}

// They are libraries of their own: see core/CMakeLists.txt.
TEST(Layers, CoreDoesNotSeeCompareAndReference) {
  const std::regex kApart("core/(compare|reference)(/.*)?");
  for (const fs::path& file : sources(kRoot / "core")) {
    const std::string room = fs::relative(file, kRoot).parent_path().string();
    for (const Include& include : includes_of(kRoot, file)) {
      const std::string other = room_of(kRoot, include.what);
      EXPECT_TRUE(!std::regex_match(other, kApart) || std::regex_match(room, kApart)) << include.text();
    }
  }
}

TEST(Layers, ARoomHasFewFiles) {
  for (const auto& [floor, others] : kMaySee)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / floor)) {
      if (!entry.is_directory() || entry.path().parent_path().filename() == "include") continue;
      EXPECT_LE(std::ranges::count_if(fs::directory_iterator(entry.path()), is_source), kMostFiles)
          << entry.path();
    }
}

TEST(Layers, TheLaboratoryIsApart) {
  for (const char* room : {"chart", "one_ray", "rays", "stability"})
    for (const fs::path& file : sources(kRoot / "bench" / room))
      for (const Include& include : includes_of(kRoot, file))
        EXPECT_TRUE(!include.what.starts_with("bench/") || include.what.starts_with("bench/one_ray/") ||
                    include.what.starts_with("bench/" + std::string(room) + "/"))
            << include.text();
  for (const fs::path& file : sources(kRoot / "app")) {
    if (kLaboratoryVerbs.count(file.filename().string())) continue;
    for (const Include& include : includes_of(kRoot, file))
      EXPECT_FALSE(kLaboratory.count(floor_of(include.what))) << include.text();
  }
}

TEST(Layers, TheProgramDoesNotSeeTheEnginesParts) {
  for (const fs::path& file : sources(kRoot / "app"))
    for (const Include& include : includes_of(kRoot, file))
      EXPECT_FALSE(kOfTheEngine.count(room_of(kRoot, include.what))) << include.text();
}

TEST(Layers, GlCallsLiveInGlAlone) {
  const std::regex kCall(R"(\bgl[A-Z]\w*\()");
  for (const char* floor : {"core", "hybrid", "app", "bench", "scenes"})
    for (const fs::path& file : sources(kRoot / floor)) {
      const std::string text = text_of(file);
      std::smatch call;
      EXPECT_FALSE(std::regex_search(text, call, kCall)) << file << " calls " << call.str();
    }
}

TEST(Layers, PicturesAreReadAndWrittenByCodecsAlone) {
  const std::regex kLibrary("#include <(Imf|spng|stb/stb_image|turbojpeg|webp/)");
  for (const char* floor : {"app", "bench", "core", "gl", "hybrid", "scenes"})
    for (const fs::path& file : sources(kRoot / floor))
      EXPECT_TRUE(file.parent_path().filename() == "codecs" || !std::regex_search(text_of(file), kLibrary))
          << file;
}

// The table of light kinds is in light.h. Beside it, only what computes the light of a kind names kinds, and
// the studio, which makes a light.
TEST(Layers, LightKindsAreListedOnce) {
  const std::regex kKind("Light::Kind::[a-z]|\"(directional|rectangle)\"");
  const std::set<std::string> kCompute{"light.h", "surface.cpp", "reference_lobe.cpp",
                                       "reference_shading.cpp", "studio.cpp"};
  for (const char* floor : {"app", "core", "gl", "hybrid", "python"})
    for (const fs::path& file : sources(kRoot / floor))
      EXPECT_TRUE(kCompute.count(file.filename().string()) || !std::regex_search(text_of(file), kKind))
          << file;
}

// "(walk/kernel.h)" in a comment is a file of the tree.
TEST(Layers, CommentsNameFilesThatExist) {
  const std::regex kComment("//[^\n]*"), kFile(R"((^|[^\w/.$}])((\w+/)+\w+\.(h|cpp|glsl|frag|vert))\b)");
  std::vector<std::string> files;
  for (const char* folder :
       {"app", "bench", "cmake", "core", "gl", "hybrid", "python", "scenes", "shaders", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      files.push_back(entry.path().string());
  const auto exists = [&](const std::string& name) {
    return std::ranges::any_of(files, [&](const std::string& file) { return file.ends_with("/" + name); });
  };
  for (const char* floor : {"app", "bench", "core", "gl", "hybrid", "python", "scenes"})
    for (const fs::path& file : sources(kRoot / floor)) {
      const std::string text = text_of(file);
      for (std::sregex_iterator comment(text.begin(), text.end(), kComment), end; comment != end; ++comment) {
        const std::string said = comment->str();
        for (std::sregex_iterator at(said.begin(), said.end(), kFile); at != end; ++at) {
          const std::string name = (*at)[2];
          EXPECT_TRUE(name.starts_with("GL/") || exists(name)) << file << " names " << name;
        }
      }
    }
}

TEST(Layers, AViolationIsFound) {
  const fs::path root = own_folder() / "layers";
  for (const char* room : {"core/math", "core/image", "core/scene", "gl", "hybrid"})
    fs::create_directories(root / room);
  std::ofstream(root / "core/math/bad.h") << "#pragma once\n#include \"gl/context.h\"\n";
  std::ofstream(root / "gl/bad.cpp") << "#include \"core/math/finite.h\"\n#include \"gl/good.h\"\n";
  std::ofstream(root / "core/math/worse.h") << "#include \"scenes/generator/random.h\"\n";
  std::ofstream(root / "hybrid/bad.cpp") << "#include \"bench/stability/table.h\"\n";
  EXPECT_EQ(floors_that_see_too_much(root).size(), 4u);
  ASSERT_EQ(Circles(root).found().size(), 1u);  // core/math and gl
  EXPECT_EQ(std::ranges::count(Circles(root).found()[0], '\n'), 2);
  std::ofstream(root / "core/math/a.h") << "#include \"core/image/b.h\"\n";
  std::ofstream(root / "core/image/b.h") << "#include \"core/scene/c.h\"\n";
  std::ofstream(root / "core/scene/c.h") << "#include \"core/math/a.h\"\n";
  ASSERT_EQ(Circles(root).found().size(), 2u);
  EXPECT_EQ(std::ranges::count(Circles(root).found()[0], '\n'), 3);
  fs::remove_all(root);
}

}  // namespace
}  // namespace pinocchio
