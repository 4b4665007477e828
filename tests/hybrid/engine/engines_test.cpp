// Several Engines with OpenGL in one process, beside a caller that has OpenGL of its own.
#include <cstdlib>
#include <deque>
#include <memory>
#include <thread>

#include "gl/context/current.h"
#include "gl/open/open.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

const Scene& cornell() {
  static const Scene kScene = load_or_die(source_path("scenes/cornell"));
  return kScene;
}

View view(glm::ivec2 size = {64, 48}) {
  return {.camera = first_camera(cornell()), .size = size};
}

Settings settings_of(const char* design) {
  Settings settings = by({{"design", design}});
  settings.threads = 2;
  return settings;
}

struct Backends {
  const char *first, *second;
};
const Backends kPairs[] = {{"egl", "egl"}, {"osmesa", "osmesa"}, {"egl", "osmesa"}, {"osmesa", "egl"}};

TEST(Engines, DrawSideBySideFrameByFrame) {
  for (const Backends& backends : kPairs) {
    SCOPED_TRACE(std::string(backends.first) + " and " + backends.second);
    // Other designs and sizes, so that names of one would be wrong in the other.
    const View views[] = {view(), view({80, 40})};
    const Settings settings[] = {settings_of("1"), settings_of("2")};
    std::vector<FrameResult> wanted;
    for (std::size_t i = 0; i < 2; ++i)
      wanted.push_back(Engine({.backend = "egl"}).render(cornell(), views[i], settings[i]).value());
    std::deque<Engine> engines;
    std::deque<Renderer> renderers;
    std::size_t frames[2] = {0, 0};
    std::vector<FrameRequest> requests;
    for (std::size_t i = 0; i < 2; ++i) {
      engines.emplace_back(
          EngineOptions{.backend = i == 0 ? backends.first : backends.second, .gl_debug = true});
      Settings resolved = engines[i].resolve(cornell(), views[i].size, settings[i]).value();
      resolved.exchange = Exchange::pipelined;
      resolved.reuse = false;
      requests.push_back({cornell(), Engine::prepare(cornell(), resolved), resolved, views[i]});
      renderers.emplace_back(engines[i], FrameSinks{[&, i](Frame& frame) {
                               EXPECT_TRUE(same_pixels(frame.read(), wanted[i]));
                               ++frames[i];
                             }});
    }
    for (int n = 0; n < 6; ++n)
      for (std::size_t i = 0; i < 2; ++i) renderers[i].submit(requests[i]);
    for (std::size_t i = 0; i < 2; ++i) {
      renderers[i].drain();
      engines[i].throw_gl_complaints();
      EXPECT_EQ(frames[i], 6u);
    }
    renderers.clear();
    engines.pop_front();  // the first one first
    EXPECT_TRUE(same_pixels(engines.front().render(cornell(), views[1], settings[1]).value(), wanted[1]));
  }
}

TEST(Engines, EndInEitherOrderAndOneAfterTheOther) {
  const FrameResult wanted = Engine({.backend = "egl"}).render(cornell(), view(), settings_of("1")).value();
  for (const bool first_ends_first : {true, false})
    for (const Backends& backends : kPairs) {
      auto first = std::make_unique<Engine>(EngineOptions{.backend = backends.first, .gl_debug = true});
      auto second = std::make_unique<Engine>(EngineOptions{.backend = backends.second, .gl_debug = true});
      for (Engine* engine : {first.get(), second.get(), first.get()})
        EXPECT_TRUE(same_pixels(engine->render(cornell(), view(), settings_of("1")).value(), wanted));
      (first_ends_first ? first : second).reset();
      Engine& left = first_ends_first ? *second : *first;
      EXPECT_TRUE(same_pixels(
          left.render(cornell(), view({40, 30}), settings_of("2")).value(),
          Engine({.backend = "egl"}).render(cornell(), view({40, 30}), settings_of("2")).value()));
      EXPECT_TRUE(same_pixels(left.render(cornell(), view(), settings_of("1")).value(), wanted));
      left.throw_gl_complaints();
    }
}

TEST(Engines, LeaveNoContextCurrent) {
  const gl::NativeContext none = gl::NativeContext::now();
  for (const char* backend : {"egl", "osmesa"}) {
    Engine engine({.backend = backend});
    ASSERT_TRUE(engine.render(cornell(), view(), settings_of("1")));
    EXPECT_TRUE(gl::NativeContext::now().is_context_of(none)) << backend;
    EXPECT_EQ(gl::current, nullptr);
  }
  EXPECT_TRUE(gl::NativeContext::now().is_context_of(none));
  EXPECT_THROW(Engine({.device = "99"}).open_gl(), NoOpenGlError);
  EXPECT_TRUE(gl::NativeContext::now().is_context_of(none));
}

// With a display, GLFW's too, which are GLX's (tests/hybrid/CMakeLists.txt runs it with one).
std::vector<const char*> ways_to_contexts() {
  if (std::getenv("DISPLAY")) return {"egl", "osmesa", "glfw"};
  return {"egl", "osmesa"};
}

// Also where none of its own can be had, and inside callbacks.
TEST(Engines, TheCallersContextStaysCurrent) {
  for (const char* callers : ways_to_contexts())
    for (const char* backend : ways_to_contexts()) {
      SCOPED_TRACE(std::string(backend) + " beside the caller's " + callers);
      const auto context = gl::open_context({callers, "", true});
      const gl::NativeContext before = gl::NativeContext::now();
      const auto expect_before = [&] {
        EXPECT_TRUE(gl::NativeContext::now() == before);
        GLint major = 0;
        glGetIntegerv(GL_MAJOR_VERSION, &major);
        EXPECT_GE(major, 3);
      };
      {
        Engine engine({.backend = backend, .gl_debug = true});
        const Settings settings = engine.resolve(cornell(), view().size, settings_of("1")).value();
        expect_before();
        Renderer renderer(engine, {[&](Frame& frame) {
                                     expect_before();
                                     EXPECT_EQ(frame.read().ids.size(), view().size);
                                     expect_before();
                                   },
                                   [&](const FrameRecord&) { expect_before(); }});
        renderer.submit({cornell(), Engine::prepare(cornell(), settings), settings, view()});
        expect_before();
        renderer.drain();
        engine.throw_gl_complaints();
      }
      expect_before();
      EXPECT_THROW(Engine({.device = "99"}).open_gl(), NoOpenGlError);
      expect_before();
      context->throw_complaints();
    }
}

TEST(Engines, AreUsedByThreadsInTurns) {
  Engine engine({.backend = "egl", .gl_debug = true});
  const FrameResult wanted = engine.render(cornell(), view(), settings_of("1")).value();
  for (int i = 0; i < 3; ++i)
    std::thread([&] {
      EXPECT_TRUE(same_pixels(engine.render(cornell(), view(), settings_of("1")).value(), wanted));
    }).join();
  engine.throw_gl_complaints();
}

// OSMesa crashed in destructors that run after its own.
TEST(Engines, MayLiveUntilTheProcessEnds) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  for (const char* backend : {"egl", "osmesa"}) {
    const auto draw_and_exit = [&] {
      static std::unique_ptr<Engine> engine;  // destroyed last
      engine = std::make_unique<Engine>(EngineOptions{.backend = backend});
      const bool drawn = engine->render(cornell(), view(), settings_of("1")).has_value();
      std::exit(drawn ? 0 : 1);
    };
    EXPECT_EXIT(draw_and_exit(), testing::ExitedWithCode(0), "") << backend;
  }
}

}  // namespace
}  // namespace pinocchio
