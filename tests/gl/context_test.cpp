#include <unistd.h>

#include <csignal>
#include <type_traits>

#include "gl/context/error.h"
#include "gl/objects/buffer.h"
#include "gl/objects/framebuffer.h"
#include "gl/open/apart.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

using ContextTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, ContextTest, kBackends, backend_name);

TEST_P(ContextTest, IsCoreAndSaysWhatItIs) {
  EXPECT_GE(10 * context().info().major + context().info().minor, 33);
  EXPECT_EQ(context().info().backend, GetParam());
  EXPECT_FALSE(context().info().renderer.empty());
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_FALSE(gl::context_lost());
}

TEST(Apart, ReportsArriveWhateverTheEnd) {
  const gl::Apart done = gl::try_apart([](const gl::Report& report) {
    report("one");
    report("");
    report(std::string(100'000, 'x'));
  });
  EXPECT_EQ(done.failure, "");
  EXPECT_EQ(done.reports, (std::vector<std::string>{"one", "", std::string(100'000, 'x')}));
  const gl::Apart crashed = gl::try_apart([](const gl::Report& report) {
    report("one");
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer's would end it otherwise
    std::raise(SIGSEGV);
  });
  EXPECT_EQ(crashed.failure, "it crashes: Segmentation fault");
  EXPECT_EQ(crashed.reports, std::vector<std::string>{"one"});
  EXPECT_NE(gl::try_apart([](const gl::Report&) { throw gl::Error("never caught"); }).failure, "");
  EXPECT_EQ(gl::try_apart([](const gl::Report&) { pause(); }, 1).failure, "it hangs: no answer in 1 s");
}

TEST(Open, TriesSoftwareDevicesAfterHardware) {
  const std::vector<gl::Attempt> attempts = gl::try_all_contexts();
  ASSERT_GE(attempts.size(), 2u);
  EXPECT_EQ(attempts[attempts.size() - 2].what, "OSMesa");
  EXPECT_EQ(attempts.back().what, "GLFW window");  // which "auto" never takes
  bool software_seen = false, works = false;
  for (const gl::Attempt& a : attempts) {
    if (a.what.rfind("EGL device", 0) == 0) {
      const bool software = a.what.find("(software)") != std::string::npos;
      EXPECT_FALSE(software_seen && !software) << a.what;
      software_seen = software_seen || software;
    }
    works = works || a.failure.empty();
    EXPECT_TRUE(a.failure.empty() != a.info.renderer.empty()) << a.what;  // either reason or result
  }
  EXPECT_TRUE(works);
}

TEST(Open, SaysWhyNoContextWorks) {
  try {
    (void)gl::open_context({"egl", "99", false});
    FAIL() << "device 99 was opened";
  } catch (const gl::NoContextError& error) {
    EXPECT_NE(std::string(error.what()).find("--device 99"), std::string::npos) << error.what();
  }
}

TEST(Open, TwoContextsTakeTurns) {
  const auto first = gl::open_context({"egl", "", true});
  const gl::Buffer in_first(std::span<const int>({1, 2, 3}));
  const auto second = gl::open_context({"osmesa", "", true});
  { const gl::Buffer in_second(std::span<const int>({4, 5})); }
  first->make_current();
  GLint size = 0;
  glBindBuffer(GL_COPY_READ_BUFFER, in_first.name());
  glGetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &size);
  EXPECT_EQ(size, 12);
  EXPECT_TRUE(first->complaints().empty());
}

TEST(Debug, DriverComplaintsAreKept) {
  const auto context = gl::open_context({"auto", "", true});
  if (!glDebugMessageCallback) GTEST_SKIP() << "the driver has no GL_KHR_debug";
  glEnable(0xdead);
  ASSERT_FALSE(context->complaints().empty());
  EXPECT_THROW(context->throw_complaints(), gl::Error);
}

static_assert(!std::is_copy_constructible_v<gl::Buffer> && std::is_nothrow_move_constructible_v<gl::Buffer>);
static_assert(!std::is_copy_constructible_v<gl::Framebuffer> && std::is_move_assignable_v<gl::Framebuffer>);

using HandleTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, HandleTest, kBackends, backend_name);

TEST_P(HandleTest, MovesAndDeletes) {
  GLuint name = 0;
  {
    gl::Texture texture({4, 4}, gl::kR8Ui);
    name = texture.name();
    gl::Texture moved = std::move(texture);
    EXPECT_EQ(moved.name(), name);
    EXPECT_EQ(texture.name(), 0u);  // NOLINT: what a moved-from handle holds is the point
    EXPECT_TRUE(glIsTexture(name));
  }
  EXPECT_FALSE(glIsTexture(name));
}

TEST_P(HandleTest, TooLargeAPictureIsAnErrorThatNamesTheLimit) {
  try {
    const gl::Texture texture({1 << 20, 1}, gl::kR8Ui);
    FAIL();
  } catch (const gl::Error& error) {
    EXPECT_NE(std::string(error.what()).find("limit"), std::string::npos);
  }
}

}  // namespace
}  // namespace pinocchio
