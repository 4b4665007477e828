#include "gl/glfw.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <string_view>

#include "gl/error.h"

namespace pinocchio::gl {
namespace {

// What GLFW says of its last failure.
std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW does not say why";
}

// When the display goes away, Xlib ends the program by itself, whatever runs on other threads, with two
// lines of its own. Ours is one, and nothing is torn down under a running thread.
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

std::shared_ptr<void> init_library() {
  static std::weak_ptr<void> running;
  if (std::shared_ptr<void> library = running.lock()) return library;
  if (!glfwInit()) throw Error(glfw_error());
  listen_for_lost_display();
  std::shared_ptr<void> library(nullptr, [](void*) { glfwTerminate(); });
  running = library;
  return library;
}

struct Version {
  int major, minor;
  bool robust;  // tells when the GPU was reset
};

void set_hints(const Version& version, const GlfwContext::Request& request) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, request.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, version.robust ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS);
  glfwWindowHint(GLFW_VISIBLE, request.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // depth is in framebuffer objects
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

}  // namespace

GlfwContext::GlfwContext(const Request& request) : library_(init_library()) {
  open(request);
  try {
    make_current();
    describe("glfw", "GLFW window", request.debug);
  } catch (...) {
    release();
    drop_data();
    glfwDestroyWindow(window_);
    throw;
  }
}

GlfwContext::~GlfwContext() {
  release();
  drop_data();
  glfwDestroyWindow(window_);
}

void GlfwContext::open(const Request& request) {
  constexpr std::array<Version, 4> kVersions{{{4, 5, true}, {4, 5, false}, {3, 3, true}, {3, 3, false}}};
  std::string failure;
  for (const Version& version : kVersions) {
    set_hints(version, request);
    window_ = glfwCreateWindow(request.size.x, request.size.y, request.title.c_str(), nullptr, nullptr);
    if (window_) {
      glfwGetError(nullptr);  // of the versions before
      return;
    }
    failure = glfw_error();
  }
  throw Error(failure);
}

void GlfwContext::bind() {
  glfwMakeContextCurrent(window_);
  if (glfwGetCurrentContext() != window_) throw Error(glfw_error());
}

void GlfwContext::unbind() {
  glfwMakeContextCurrent(nullptr);
}

bool GlfwContext::is_bound() const {
  return glfwGetCurrentContext() == window_;
}

// GLFW knows of its own windows alone, and another way to make one current leaves it behind.
void GlfwContext::enter() {
  callers_window_ = glfwGetCurrentContext();
  Context::enter();
}

void GlfwContext::leave() noexcept {
  if (callers_window_ && callers_window_ != window_) glfwMakeContextCurrent(callers_window_);
  Context::leave();
}

GLADloadfunc GlfwContext::loader() const {
  return glfwGetProcAddress;
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
