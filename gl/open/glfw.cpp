#include "gl/open/glfw.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <utility>

#include "gl/context/error.h"
#include "gl/open/glfw_library.h"

namespace pinocchio::gl {
namespace {

// GLFW's message for its last failure.
std::string glfw_error() {
  const char* text = nullptr;
  glfw().GetError(&text);
  return text ? text : "GLFW does not say why";
}

// When the display goes away, Xlib prints two lines and exits while other threads run. This handler prints
// one line and ends the process without tearing anything down under a running thread.
int on_lost_display(void*) {
  constexpr std::string_view kLine = "pinocchio: the display is gone\n";
  (void)!write(STDERR_FILENO, kLine.data(), kLine.size());
  _exit(1);
}

void listen_for_lost_display() {
  void* const xlib = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
  if (!xlib) return;  // another window system
  using Handler = int (*)(void*);
  using SetHandler = Handler (*)(Handler);
  if (const auto set = reinterpret_cast<SetHandler>(dlsym(xlib, "XSetIOErrorHandler"))) set(on_lost_display);
  dlclose(xlib);
}

// Whether GLFW is already initialised in this process.
bool is_initialised() {
  glfw().GetError(nullptr);
  (void)glfw().GetTimerFrequency();
  return glfw().GetError(nullptr) != GLFW_NOT_INITIALIZED;
}

// GLFW is terminated with the last context, unless the caller initialised it and has windows of its own.
std::shared_ptr<void> init_library() {
  static std::weak_ptr<void> running;
  if (std::shared_ptr<void> library = running.lock()) return library;
  const bool is_callers = is_initialised();
  if (!glfw().Init()) throw Error(glfw_error());
  listen_for_lost_display();
  std::shared_ptr<void> library(&running, [is_callers](void*) {  // the pointer must not be null
    if (!is_callers) glfw().Terminate();
  });
  running = library;
  return library;
}

struct Version {
  int major, minor;
  bool robust;  // the context tells when the GPU was reset
};

void set_hints(const Version& version, const GlfwContext::Request& request) {
  glfw().DefaultWindowHints();
  glfw().WindowHint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
  glfw().WindowHint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
  glfw().WindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw().WindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfw().WindowHint(GLFW_OPENGL_DEBUG_CONTEXT, request.debug ? GLFW_TRUE : GLFW_FALSE);
  glfw().WindowHint(GLFW_CONTEXT_ROBUSTNESS,
                    version.robust ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS);
  glfw().WindowHint(GLFW_VISIBLE, request.visible ? GLFW_TRUE : GLFW_FALSE);
  glfw().WindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfw().WindowHint(GLFW_DEPTH_BITS, 0);  // framebuffer objects have depth
  glfw().WindowHint(GLFW_STENCIL_BITS, 0);
}

}  // namespace

GlfwContext::GlfwContext(const Request& request)
    : library_(init_library()), callers_window_(glfw().GetCurrentContext()) {
  open(request);
  try {
    make_current();
    native_ = NativeContext::now();
    describe("glfw", "GLFW window", request.debug);
  } catch (...) {
    release();
    drop_data();
    glfw().DestroyWindow(window_);
    throw;
  }
}

GlfwContext::~GlfwContext() {
  callers_window_ = nullptr;  // it may be destroyed already
  release();
  drop_data();
  glfw().DestroyWindow(window_);
}

void GlfwContext::open(const Request& request) {
  // GLFW makes a new window's context current at once. X refuses that while a context of EGL is current.
  NativeContext::now().release();
  constexpr std::array<Version, 4> kVersions{{{4, 5, true}, {4, 5, false}, {3, 3, true}, {3, 3, false}}};
  std::string failure;
  for (const Version& version : kVersions) {
    set_hints(version, request);
    window_ = glfw().CreateWindow(request.size.x, request.size.y, request.title.c_str(), nullptr, nullptr);
    if (window_) {
      glfw().GetError(nullptr);  // drops the errors of newer versions
      return;
    }
    failure = glfw_error();
  }
  throw Error(failure);
}

void GlfwContext::bind() {
  glfw().MakeContextCurrent(window_);
  if (glfw().GetCurrentContext() != window_) throw Error(glfw_error());
}

// GLFW knows only its own windows, and does not notice when another context is made current.
bool GlfwContext::is_bound() const {
  return glfw().GetCurrentContext() == window_ && native_.is_context_of(NativeContext::now());
}

void GlfwContext::unbind() {
  glfw().MakeContextCurrent(std::exchange(callers_window_, nullptr));
}

void GlfwContext::enter() {
  callers_window_ = glfw().GetCurrentContext();
  if (callers_window_ == window_) callers_window_ = nullptr;
  Context::enter();
}

GLADloadfunc GlfwContext::loader() const {
  return glfw().GetProcAddress;
}

Candidate glfw_candidate() {
  Candidate c;
  c.backend = "glfw";
  c.what = "GLFW window";
  c.open = [](bool debug) {
    GlfwContext::Request request;
    request.debug = debug;
    return std::make_unique<GlfwContext>(request);
  };
  return c;
}

}  // namespace pinocchio::gl
