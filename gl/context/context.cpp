#include "gl/context/context.h"

#include <array>
#include <string_view>
#include <utility>

#include "gl/context/error.h"

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

}  // namespace

constinit thread_local ContextData* current = nullptr;

void delete_in(const std::weak_ptr<ContextData>& context, std::function<void()> deletion) noexcept {
  const std::shared_ptr<ContextData> data = context.lock();
  if (!data) return;
  if (data.get() == current) return deletion();
  const std::lock_guard lock(data->mutex);
  data->deletions.push_back(std::move(deletion));
}

Context::~Context() {
  drop_data();
}

void Context::drop_data() {
  if (current == data_.get()) current = nullptr;
  data_.reset();
}

void Context::make_current() {
  if (!is_bound()) {
    NativeContext::now().release();
    bind();
  }
  load_functions();
}

void Context::release() {
  if (is_bound()) unbind();
  if (current == data_.get()) current = nullptr;
}

void Context::enter() {
  callers_ = NativeContext::now();
  callers_data_ = current;
  if (!is_bound()) {
    callers_.release();
    try {
      bind();
    } catch (...) {
      callers_.restore();
      throw;
    }
  }
  current = data_.get();
  clear_errors();  // a frame that failed may have left some
  run_deletions();
}

void Context::leave() noexcept {
  if (!(NativeContext::now() == callers_)) {
    unbind();
    callers_.restore();
  }
  current = callers_data_;
}

void Context::load_functions() {
  if (!has_functions_ && !pinocchio_gladLoadGLContext(&data_->functions, loader()))
    throw Error("the OpenGL functions of this context cannot be loaded");
  has_functions_ = true;
  current = data_.get();
  run_deletions();
}

void Context::run_deletions() {
  std::vector<std::function<void()>> deletions;
  {
    const std::lock_guard lock(data_->mutex);
    deletions.swap(data_->deletions);
  }
  for (const std::function<void()>& deletion : deletions) deletion();
}

void GLAD_API_PTR Context::collect(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei,
                                   const GLchar* message, const void* complaints) {
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;  // Program reports them, with file and line
  if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR &&
      severity != GL_DEBUG_SEVERITY_HIGH)
    return;
  static_cast<std::vector<std::string>*>(const_cast<void*>(complaints))->emplace_back(message);
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

namespace {

// A lost context may report errors without end.
constexpr int kMostErrors = 16;

const char* name_of(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
  }
  return "an error without a name";
}

}  // namespace

void throw_errors(const std::string& no_room) {
  const GLenum first = glGetError();
  if (first == GL_NO_ERROR) return;
  bool is_memory_full = first == GL_OUT_OF_MEMORY;  // it explains more than errors reported before it
  for (int i = 0; i < kMostErrors; ++i) {
    const GLenum next = glGetError();
    if (next == GL_NO_ERROR) break;
    is_memory_full = is_memory_full || next == GL_OUT_OF_MEMORY;
  }
  if (first == GL_CONTEXT_LOST || context_lost())
    throw ContextLostError("the GPU was reset and its OpenGL context is lost; start again");
  if (is_memory_full) throw Error(no_room + "; a smaller picture or --mode raytrace needs less");
  throw Error(std::string("OpenGL failed while it drew: ") + name_of(first));
}

void clear_errors() noexcept {
  for (int i = 0; i < kMostErrors && glGetError() != GL_NO_ERROR; ++i) {
  }
}

bool context_lost() {
  return glGetGraphicsResetStatus && glGetGraphicsResetStatus() != GL_NO_ERROR;
}

}  // namespace pinocchio::gl
