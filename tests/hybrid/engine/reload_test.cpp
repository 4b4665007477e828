// Shaders changed while the program runs.
#include <fstream>
#include <sstream>

#include "gl/context/error.h"
#include "tests/support/frames.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kReloadSize{64, 48};

class ReloadTest : public FramesTest {
 protected:
  void SetUp() override {
    FramesTest::SetUp();
    folder_ = own_folder() / "shaders";
    std::filesystem::copy(source_path("shaders"), folder_, std::filesystem::copy_options::recursive);
    setenv("PINOCCHIO_SHADERS", folder_.c_str(), 1);
    renderer_.emplace(*engine_, FrameSinks{[this](Frame& frame) { frame.read_color(picture_); }, {}});
    Scene scene = plate_over_floor();
    scene.lights = {point_light({1, 5, 1})};
    request_ = request(scene, settings_for(scene), kReloadSize);
  }
  void TearDown() override {
    renderer_.reset();
    unsetenv("PINOCCHIO_SHADERS");
    FramesTest::TearDown();
  }

  Image<glm::vec4> picture() {
    renderer_->submit(request_);
    renderer_->drain();
    return picture_;
  }
  [[nodiscard]] std::string text_of(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }
  // In the file, and back again by writing what this returns.
  std::string replace(const std::string& file, const std::string& what, const std::string& by) {
    std::string text = text_of(file);
    const std::string before = text;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos);
    write(file, text.replace(at, what.size(), by));
    return before;
  }

  std::filesystem::path folder_;
  std::optional<Renderer> renderer_;
  FrameRequest request_;
  Image<glm::vec4> picture_;
};
INSTANTIATE_TEST_SUITE_P(Backends, ReloadTest, kBackends, backend_name);

TEST_P(ReloadTest, AChangedShaderDrawsTheNextFrame) {
  const Image<glm::vec4> before = picture();
  const std::string old = replace("composite.frag", "color = vec4(min(sum, kLargestHalf)",
                                  "color = vec4(min(2.0 * sum, kLargestHalf)");
  ASSERT_TRUE(std::ranges::equal(picture().pixels(), before.pixels()));  // not unasked
  ASSERT_TRUE(programs()->reload());
  const Image<glm::vec4> after = picture();
  for (std::size_t i = 0; i < before.pixels().size(); ++i)
    ASSERT_EQ(glm::vec3(after[i]), 2.0f * glm::vec3(before[i]));
  write("composite.frag", old);
  ASSERT_TRUE(programs()->reload());
  EXPECT_TRUE(std::ranges::equal(picture().pixels(), before.pixels()));
}

TEST_P(ReloadTest, AnErrorNamesFileAndLineAndTheLastGoodStay) {
  const Image<glm::vec4> before = picture();
  // The one that is changed well must not come alone.
  replace("visibility.vert", "gl_Position = vec4(clip.xy, z_near",
          "gl_Position = vec4(0.5 * clip.xy, z_near");
  const std::string old = replace("traced_light.glsl", "struct Source {", "struct Source { nonsense;");
  const std::string text = text_of("traced_light.glsl");
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("nonsense")), '\n');
  const Expected<void> broken = programs()->reload();
  ASSERT_FALSE(broken);
  const std::string message = broken.error().message();
  std::printf("  %s\n", message.c_str());
  EXPECT_NE(message.find("traced_light.glsl:" + std::to_string(line + 1)), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_TRUE(std::ranges::equal(picture().pixels(), before.pixels()));

  write("traced_light.glsl", old);
  ASSERT_TRUE(programs()->reload());
  EXPECT_FALSE(std::ranges::equal(picture().pixels(), before.pixels()));
}

TEST_P(ReloadTest, AMissingFileIsAnErrorToo) {
  const Image<glm::vec4> before = picture();
  std::filesystem::rename(folder_ / "scene_fetch.glsl", folder_ / "away");
  const Expected<void> broken = programs()->reload();
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message().find("scene_fetch.glsl"), std::string::npos);
  EXPECT_TRUE(std::ranges::equal(picture().pixels(), before.pixels()));
  std::filesystem::rename(folder_ / "away", folder_ / "scene_fetch.glsl");
  EXPECT_TRUE(programs()->reload());
  EXPECT_TRUE(std::ranges::equal(picture().pixels(), before.pixels()));
}

// Broken before it is first used: said as its frame is drawn, and good again when mended.
TEST_P(ReloadTest, AShaderThatIsBrokenFromTheStartCanBeMended) {
  const std::string old = replace("composite.frag", "void main() {", "void main() { nonsense;");
  EXPECT_THROW(picture(), gl::Error);
  write("composite.frag", old);
  EXPECT_TRUE(programs()->reload());
  EXPECT_EQ(picture().size(), kReloadSize);
}

}  // namespace
}  // namespace pinocchio
