#include "gl/objects/program.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "gl/context/error.h"
#include "gl/objects/shader_source.h"
#include "tests/support/gl_test.h"
#include "tests/support/own_file.h"
#include "tests/support/source_path.h"

namespace pinocchio {
namespace {

const std::filesystem::path kShaders = source_path("shaders");

std::filesystem::path folder_with(const std::string& file, const std::string& text) {
  const std::filesystem::path folder = own_folder() / "shaders";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / file) << text;
  return folder;
}

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const gl::Error& error) {
    return error.what();
  }
  return "";
}

using ProgramTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, ProgramTest, kBackends, backend_name);

TEST_P(ProgramTest, EveryShaderCompilesInEveryVariant) {
  constexpr std::array kBits{"ID_BITS 16", "ID_BITS 24", "ID_BITS 32"};
  for (const char* bits : kBits) {
    EXPECT_NO_THROW(gl::Program(kShaders, "visibility.vert", "visibility.frag", {bits}));
    for (const char* file : {"accumulate.frag", "composite.frag", "gbuffer.frag", "inspect.frag"})
      EXPECT_NO_THROW(gl::Program(kShaders, "fullscreen.vert", file, {bits}));
    for (const char* texels : {"FINISHED_TEXELS 1", "FINISHED_TEXELS 3"})
      EXPECT_NO_THROW(gl::Program(kShaders, "fullscreen.vert", "show.frag", {bits, texels}));
    EXPECT_NO_THROW(gl::Program(kShaders, "fullscreen.vert", "gbuffer.frag", {bits, "NORMALS_ONLY"}));
  }
  // ID_BITS changes one line of a shader. To save time, each of these variants is compiled with one of its
  // values, in turn.
  std::size_t turn = 0;
  const auto compile = [&](const char* file, std::vector<std::string> definitions, const char* shown) {
    definitions.emplace_back(kBits[turn++ % kBits.size()]);
    if (*shown) definitions.emplace_back(shown);
    EXPECT_NO_THROW(gl::Program(kShaders, "fullscreen.vert", file, definitions)) << shown;
  };
  for (const std::vector<std::string>& definitions : std::initializer_list<std::vector<std::string>>{
           {"HAS_MASK", "MASK_BITS 1", "MASK_SCALE 1"},
           {"HAS_MASK", "MASK_BITS 8", "MASK_SCALE 1", "HAS_REFLECTION", "REFLECTION_SCALE 1",
            "REFLECTION_TEXELS 3", "REPROJECT"},
           {"HAS_MASK", "MASK_BITS 2", "MASK_SCALE 4", "HAS_REFLECTION", "REFLECTION_SCALE 2",
            "REFLECTION_TEXELS 1", "REFLECTION_TILE 16"},
           {"HAS_MAPS", "MAP_USES 65535", "HAS_COLORS", "HAS_TANGENTS", "FREE_LIGHTS_ONLY"}}) {
    compile("composite.frag", definitions, "");
    for (const char* shown : {"SHOW_IDS", "SHOW_NORMALS", "SHOW_MASK", "SHOW_DELAY"})
      compile("inspect.frag", definitions, shown);
  }
}

TEST_P(ProgramTest, MistakeIsNamedWithFileAndLine) {
  const auto folder = folder_with("part.glsl", "// fine\nfloat broken( { }\n");
  folder_with("bad.frag",
              "#version 330 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = vec4(0.0); }\n");
  folder_with("good.vert", "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  const std::string error = error_of([&] { gl::Program(folder, "good.vert", "bad.frag"); });
  EXPECT_NE(error.find("part.glsl:2"), std::string::npos) << error;
}

// GLSL leaves 1.0 / 0.0 open: a driver may refuse it, or answer anything.
TEST(ShaderSource, NoneDividesByZero) {
  const std::regex by_zero(R"([^/]/\s*0+(\.0*f?)?\s*[^0-9.x\s])");
  ASSERT_TRUE(std::regex_search("x = 1.0 / 0.0;", by_zero));
  ASSERT_FALSE(std::regex_search("x = y / 0.25;", by_zero));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kShaders)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_FALSE(std::regex_search(text, by_zero)) << entry.path();
  }
}

TEST(ShaderSource, MissingFileAndEndlessIncludeAreErrors) {
  EXPECT_NE(error_of([] { (void)gl::assemble_shader(kShaders, "none.frag", {}); }).find("none.frag"),
            std::string::npos);
  const auto folder = folder_with("self.glsl", "#include \"self.glsl\"\n");
  EXPECT_NE(error_of([&] { (void)gl::assemble_shader(folder, "self.glsl", {}); }).find("includes itself"),
            std::string::npos);
}

TEST(ShaderSource, NamesFilesInBothVendorsWords) {
  EXPECT_EQ(gl::name_files("1:12(3): error: x", {"a.frag", "b.glsl"}), "b.glsl:12: error: x");
  EXPECT_EQ(gl::name_files("0(7) : error C0000: x", {"a.frag"}), "a.frag:7 : error C0000: x");
}

}  // namespace
}  // namespace pinocchio
