// Any OpenGL call of a frame may fail: one clear error, nothing is left behind, and the next frame is drawn.
#include <dlfcn.h>

#include <map>
#include <set>
#include <string_view>

#include "gl/open/open.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

// Calls as the driver gets them: the n-th of those below does nothing but report an error.
struct Calls {
  int count = 0;
  int fails_at = 0;  // counted from 1; 0: none
  std::string failed;
  GLenum error = GL_NO_ERROR;
  std::set<std::pair<std::string, GLuint>> alive;  // objects, by kind and name
} calls;

bool fails(const char* name) {
  if (++calls.count != calls.fails_at) return false;
  calls.failed = name;
  calls.error = GL_OUT_OF_MEMORY;
  return true;
}

using Functions = PinocchioGladGLContext;

template <auto Member>
struct Failing;
template <class Result, class... Arguments, Result (*Functions::*Member)(Arguments...)>
struct Failing<Member> {
  static inline Result (*real)(Arguments...) = nullptr;
  static inline const char* name = nullptr;
  static Result call(Arguments... arguments) {
    if (!fails(name)) return real(arguments...);
    return Result();
  }
};
template <>
struct Failing<&Functions::ClientWaitSync> {
  static inline PFNGLCLIENTWAITSYNCPROC real = nullptr;
  static inline const char* name = nullptr;
  static GLenum call(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    return fails(name) ? GL_WAIT_FAILED : real(sync, flags, timeout);
  }
};

// Objects that are made and deleted.
template <auto Member>
struct Counted {
  static inline PFNGLGENBUFFERSPROC real = nullptr;
  static inline const char* name = nullptr;
  static void make(GLsizei n, GLuint* names) {
    if (fails(name)) return;
    real(n, names);
    for (GLsizei i = 0; i < n; ++i) calls.alive.emplace(std::string(name).substr(5), names[i]);
  }
};
template <auto Member>
struct Deleting {
  static inline PFNGLDELETEBUFFERSPROC real = nullptr;
  static inline const char* name = nullptr;
  static void end(GLsizei n, const GLuint* names) {
    real(n, names);
    for (GLsizei i = 0; i < n; ++i) calls.alive.erase({std::string(name).substr(8), names[i]});
  }
};

GLenum get_error() {
  static const auto kReal =
      reinterpret_cast<PFNGLGETERRORPROC>(reinterpret_cast<EngineOptions::GetProcAddress>(
          dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetProcAddress"))("glGetError"));
  const GLenum error = std::exchange(calls.error, GL_NO_ERROR);
  return error != GL_NO_ERROR ? error : kReal();
}

using Function = void (*)();
using Wrappers = std::map<std::string, std::function<Function(Function)>>;

template <class Wrapper, class Call>
void wrap(Wrappers& to, const char* name, Call call) {
  to[name] = [name, call](Function real) {
    Wrapper::name = name;
    Wrapper::real = reinterpret_cast<decltype(Wrapper::real)>(real);
    return reinterpret_cast<Function>(call);
  };
}

#define FAILING(name) wrap<Failing<&Functions::name>>(all, "gl" #name, &Failing<&Functions::name>::call)
#define COUNTED(name)                                                                              \
  wrap<Counted<&Functions::Gen##name>>(all, "glGen" #name, &Counted<&Functions::Gen##name>::make); \
  wrap<Deleting<&Functions::Delete##name>>(all, "glDelete" #name, &Deleting<&Functions::Delete##name>::end)

// All that may fail: what allocates, compiles, draws, and moves data.
const Wrappers& wrappers() {
  static const Wrappers kAll = [] {
    Wrappers all;
    COUNTED(Buffers);
    COUNTED(Framebuffers);
    COUNTED(Queries);
    COUNTED(Textures);
    COUNTED(VertexArrays);
    FAILING(AttachShader);
    FAILING(BufferData);
    FAILING(BufferStorage);
    FAILING(CheckFramebufferStatus);
    FAILING(ClearBufferfv);
    FAILING(ClearBufferuiv);
    FAILING(ClientWaitSync);
    FAILING(CompileShader);
    FAILING(CreateProgram);
    FAILING(CreateShader);
    FAILING(DrawArrays);
    FAILING(DrawElements);
    FAILING(EnableVertexAttribArray);
    FAILING(FenceSync);
    FAILING(FramebufferTexture2D);
    FAILING(GetInteger64v);
    FAILING(GetProgramiv);
    FAILING(GetQueryObjectui64v);
    FAILING(GetShaderiv);
    FAILING(GetUniformLocation);
    FAILING(LinkProgram);
    FAILING(MapBufferRange);
    FAILING(QueryCounter);
    FAILING(ReadPixels);
    FAILING(ShaderSource);
    FAILING(TexBuffer);
    FAILING(TexImage2D);
    FAILING(TexParameteri);
    FAILING(TexSubImage2D);
    FAILING(Uniform1f);
    FAILING(Uniform1i);
    FAILING(Uniform1ui);
    FAILING(Uniform2f);
    FAILING(Uniform3f);
    FAILING(UniformMatrix3fv);
    FAILING(UnmapBuffer);
    FAILING(VertexAttribPointer);
    return all;
  }();
  return kAll;
}

Function find(const char* name) {
  static const auto kFind = reinterpret_cast<EngineOptions::GetProcAddress>(
      dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetProcAddress"));
  if (std::string_view(name) == "glGetError") return reinterpret_cast<Function>(get_error);
  const Function real = kFind(name);
  const auto wrapper = wrappers().find(name);
  return real && wrapper != wrappers().end() ? wrapper->second(real) : real;
}

class FailingCallTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Designs, FailingCallTest, testing::Values("1", "2"),
                         [](const testing::TestParamInfo<const char*>& of) { return std::string(of.param); });

TEST_P(FailingCallTest, IsOneErrorAndTheNextFrameIsDrawn) {
  const auto context = gl::open_context({"egl", "", false});
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const View view{.camera = first_camera(scene), .size = {24, 16}};
  Settings settings = by({{"design", GetParam()}});
  settings.threads = 2;
  settings.spp = 2;  // the second has all that the first one made
  const auto draw = [&](Engine& engine) { return engine.render(scene, view, settings).value(); };
  calls = {};
  std::optional<FrameResult> wanted;
  {
    Engine engine({.get_proc_address = find});
    wanted = draw(engine);
  }
  EXPECT_TRUE(calls.alive.empty());
  const int all = calls.count;
  ASSERT_GT(all, 200);
  int errors = 0;
  for (int n = 1; n <= all; ++n) {
    calls = {};
    calls.fails_at = n;
    {
      Engine engine({.get_proc_address = find});
      try {
        EXPECT_TRUE(same_pixels(draw(engine), *wanted)) << n << ": " << calls.failed << " failed, unseen";
      } catch (const OpenGlError& error) {
        ++errors;
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
        EXPECT_GT(std::string_view(error.what()).size(), 20u);
      }
      calls.fails_at = 0;
      EXPECT_TRUE(same_pixels(draw(engine), *wanted)) << "after " << n << ": " << calls.failed;
    }
    EXPECT_TRUE(calls.alive.empty()) << calls.alive.size() << " objects of kind "
                                     << calls.alive.begin()->first << " are left after " << n << ": "
                                     << calls.failed;
    if (HasFailure()) return;
  }
  std::printf("  %d calls, %d errors\n", all, errors);
  EXPECT_GT(errors, all / 2);
}

}  // namespace
}  // namespace pinocchio
