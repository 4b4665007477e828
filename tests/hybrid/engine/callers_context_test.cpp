// Frames in a caller's context, whatever its state: the picture is the same, and so is the state afterwards.
#include <dlfcn.h>

#include "gl/open/open.h"
#include "tests/hybrid/engine/hostile_states.h"
#include "tests/support/draw.h"
#include "tests/support/gl_state.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{96, 64};

EngineOptions::GetProcAddress egl_functions() {
  static const auto kFind = reinterpret_cast<EngineOptions::GetProcAddress>(
      dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetProcAddress"));
  return kFind;
}

const Scene& two_lights() {
  static const Scene kScene = load_or_die(source_path("scenes/two-lights.gltf"));
  return kScene;
}

View view() {
  return {.camera = first_camera(two_lights()), .size = kSize};
}

Settings of_design(const char* design) {
  Settings settings = by({{"design", design}});
  settings.threads = 2;
  return settings;
}

class CallersContextTest : public testing::TestWithParam<Hostile> {
 protected:
  std::unique_ptr<gl::Context> callers_ = gl::open_context({"egl", "", false});
};
INSTANTIATE_TEST_SUITE_P(States, CallersContextTest, testing::ValuesIn(hostile_states()),
                         [](const testing::TestParamInfo<Hostile>& of) {
                           return std::string(of.param.name);
                         });

FrameResult clean_picture(const char* design) {
  Engine engine({.backend = "egl"});
  return engine.render(two_lights(), view(), of_design(design)).value();
}

template <class T>
std::size_t pixels_that_differ(const Image<T>& a, const Image<T>& b) {
  std::size_t count = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.pixels().size(), b.pixels().size()); ++i)
    count += a[i] != b[i] ? 1 : 0;
  return count;
}

void expect_same(const FrameResult& picture, const FrameResult& wanted) {
  EXPECT_EQ(pixels_that_differ(picture.color, wanted.color), 0u);
  EXPECT_EQ(pixels_that_differ(picture.ids, wanted.ids), 0u);
  EXPECT_EQ(pixels_that_differ(picture.reflection, wanted.reflection), 0u);
  EXPECT_TRUE(std::ranges::equal(picture.mask.bytes(), wanted.mask.bytes()));
}

std::string text_of(int version) {
  return std::to_string(version / 10) + "." + std::to_string(version % 10);
}

// A state that is set before, and one that is set while frames are delivered.
TEST_P(CallersContextTest, ChangesNoPixelAndComesBack) {
  if (gl_version() < GetParam().since)
    GTEST_SKIP() << "needs OpenGL " << text_of(GetParam().since) << ", the context has "
                 << text_of(gl_version());
  for (const char* design : {"1", "2"}) {
    SCOPED_TRACE(design);
    const FrameResult wanted = clean_picture(design);
    callers_ = gl::open_context({"egl", "", false});
    GetParam().set();
    const GlState before = read_gl_state();
    (void)glGetError();
    {
      Engine engine({.gl_debug = true, .get_proc_address = egl_functions()});
      for (int i = 0; i < 2; ++i) {
        expect_same(engine.render(two_lights(), view(), of_design(design)).value(), wanted);
        EXPECT_EQ(differences(before, read_gl_state()), std::vector<std::string>{});
      }
      engine.throw_gl_complaints();
      const Settings settings = engine.resolve(two_lights(), kSize, of_design(design)).value();
      Renderer renderer(engine,
                        {[&](Frame& frame) {
                           EXPECT_EQ(differences(before, read_gl_state()), std::vector<std::string>{});
                           EXPECT_NE(frame.texture_name(), 0u);
                           expect_same(frame.read(), wanted);
                           EXPECT_EQ(differences(before, read_gl_state()), std::vector<std::string>{});
                         },
                         {}});
      renderer.submit({two_lights(), Engine::prepare(two_lights(), settings), settings, view()});
      renderer.drain();
    }
    EXPECT_EQ(differences(before, read_gl_state()), std::vector<std::string>{});
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  }
}

TEST(CallersContext, KeepsItsProgramsSubroutines) {
  const auto context = gl::open_context({"egl", "", false});
  if (gl_version() < 40) GTEST_SKIP() << "subroutines need OpenGL 4.0";
  use_program_with_subroutine();
  Engine engine({.get_proc_address = egl_functions()});
  ASSERT_TRUE(engine.render(two_lights(), view(), of_design("1")));
  GLuint chosen = 7;
  glGetUniformSubroutineuiv(GL_VERTEX_SHADER, 0, &chosen);
  EXPECT_EQ(chosen, 1u);
}

// The caller clears a picture of its own between frames, and in the midst of them.
TEST(CallersContext, IsDrawnInByTurns) {
  const FrameResult wanted = clean_picture("1");
  const auto context = gl::open_context({"egl", "", false});
  bind_framebuffers();
  enable_all({GL_SCISSOR_TEST});
  const auto draw = [](float value) {
    glScissor(0, 0, 4, 8);
    glClearColor(value, value, value, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  const auto left_half = [] {
    GLint draws = 0, reads = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draws);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &reads);
    std::vector<std::uint8_t> pixels(8 * 8 * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(draws));
    glReadPixels(0, 0, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(reads));
    return std::pair(int{pixels[0]}, int{pixels[7 * 4]});
  };
  Engine engine({.get_proc_address = egl_functions()});
  Settings settings = engine.resolve(two_lights(), kSize, of_design("1")).value();
  settings.exchange = Exchange::pipelined;
  settings.reuse = false;
  int frames = 0;
  Renderer renderer(engine, {[&](Frame& frame) {
                               draw(1.0f);
                               expect_same(frame.read(), wanted);
                               EXPECT_EQ(left_half(), std::pair(255, 0));
                               ++frames;
                             },
                             {}});
  const auto tracer = Engine::prepare(two_lights(), settings);
  for (int i = 0; i < 5; ++i) {
    draw(0.2f);
    renderer.submit({two_lights(), tracer, settings, view()});
    EXPECT_EQ(left_half(), std::pair(i < 2 ? 51 : 255, 0));
  }
  renderer.drain();
  EXPECT_EQ(frames, 5);
}

// What cannot be suspended is refused, in words, and left alone.
TEST(CallersContext, RefusesQueriesThatWouldCountItsFrames) {
  const auto context = gl::open_context({"egl", "", false});
  Engine engine({.get_proc_address = egl_functions()});
  ASSERT_TRUE(engine.render(two_lights(), view(), of_design("1")));
  GLuint query = 0;
  glGenQueries(1, &query);
  const auto refusal = [&] {
    try {
      (void)engine.render(two_lights(), view(), of_design("1"));
    } catch (const OpenGlError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  glBeginQuery(GL_SAMPLES_PASSED, query);
  EXPECT_NE(refusal().find("GL_SAMPLES_PASSED"), std::string::npos);
  glEndQuery(GL_SAMPLES_PASSED);
  glBeginConditionalRender(query, GL_QUERY_WAIT);
  EXPECT_NE(refusal().find("glBeginConditionalRender"), std::string::npos);
  glEndConditionalRender();
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

void GLAD_API_PTR count_message(GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar*, const void* count) {
  ++*static_cast<int*>(const_cast<void*>(count));
}

TEST(CallersContext, ItsOwnDebugCallbackOutlivesTheEngine) {
  const auto context = gl::open_context({"egl", "", true});
  if (!glDebugMessageCallback) GTEST_SKIP() << "debug callbacks need GL_KHR_debug";
  int messages = 0;
  glDebugMessageCallback(count_message, &messages);
  {
    Engine engine({.gl_debug = true, .get_proc_address = egl_functions()});
    ASSERT_TRUE(engine.render(two_lights(), view(), of_design("1")));
    glEnable(0xdead);
    EXPECT_EQ(messages, 1);
    engine.throw_gl_complaints();  // it was the caller's
  }
  glEnable(0xdead);
  EXPECT_EQ(messages, 2);
}

// Else its names would be taken for another context's.
TEST(CallersContext, MustBeCurrent) {
  const auto context = gl::open_context({"egl", "", false});
  Engine engine({.get_proc_address = egl_functions()});
  ASSERT_TRUE(engine.render(two_lights(), view(), of_design("1")));
  const auto other = gl::open_context({"egl", "", false});
  EXPECT_THROW((void)engine.render(two_lights(), view(), of_design("1")), OpenGlError);
  context->make_current();
  EXPECT_TRUE(engine.render(two_lights(), view(), of_design("1")));
}

}  // namespace
}  // namespace pinocchio
