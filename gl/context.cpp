#include "gl/context.h"

#include <array>
#include <string_view>

#include "gl/error.h"

namespace pinocchio::gl {
namespace {

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

bool is_software(std::string_view renderer) {
  constexpr std::array<std::string_view, 5> kSoftware{"llvmpipe", "softpipe", "swrast", "SWR", "Software"};
  for (const std::string_view name : kSoftware)
    if (renderer.find(name) != std::string_view::npos) return true;
  return false;
}

void GLAD_API_PTR collect(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                          const void* complaints) {
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;  // Program says it, with file and line
  if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR &&
      severity != GL_DEBUG_SEVERITY_HIGH)
    return;
  static_cast<std::vector<std::string>*>(const_cast<void*>(complaints))->emplace_back(message);
}

}  // namespace

void Context::make_current() {
  bind();
  // One table of functions for the process: it belongs to the context made current last.
  if (!gladLoadGL(loader())) throw Error("the OpenGL functions of this context cannot be loaded");
}

void Context::throw_complaints() const {
  if (!complaints_.empty()) throw Error("OpenGL: " + complaints_.front());
}

void Context::describe(const std::string& backend, const std::string& device, bool debug) {
  info_.backend = backend;
  info_.device = device;
  info_.vendor = text_of(GL_VENDOR);
  info_.renderer = text_of(GL_RENDERER);
  info_.version = text_of(GL_VERSION);
  info_.software = is_software(info_.renderer);
  glGetIntegerv(GL_MAJOR_VERSION, &info_.major);
  glGetIntegerv(GL_MINOR_VERSION, &info_.minor);
  if (!glClipControl)
    throw Error("OpenGL " + info_.version +
                " lacks GL_ARB_clip_control (part of OpenGL 4.5), which is needed");
  if (debug && glDebugMessageCallback) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(collect, &complaints_);
  }
}

bool context_lost() {
  return glGetGraphicsResetStatus && glGetGraphicsResetStatus() != GL_NO_ERROR;
}

}  // namespace pinocchio::gl
