#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/current.h"
#include "gl/functions.h"

namespace pinocchio::gl {

struct ContextInfo {
  std::string backend;  // "egl", "osmesa", "glfw"
  std::string device;   // what was opened, in words
  std::string vendor, renderer, version;
  int major = 0, minor = 0;
  bool software = false;  // drawn by the processor: there is no bus to cross
};

// An OpenGL core context, 3.3 with GL_ARB_clip_control at least, that draws into framebuffer objects
// only. GL calls go to the context that is current on this thread.
class Context {
 public:
  Context() = default;
  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Makes it this thread's context, for good: for windows and tests, which have no other.
  void make_current();
  // Lets another thread take it.
  void release();

  // Between the two it is this thread's context; after them the caller's is, in the state that it was in.
  // Throws Error. Where it is this thread's already, they change nothing.
  virtual void enter();
  virtual void leave() noexcept;

  [[nodiscard]] const ContextInfo& info() const { return info_; }

  // What the driver complained about (KHR_debug: errors, undefined behaviour, high severity) since the
  // context was opened with `debug`; empty without.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }
  // Throws Error with the first complaint, if there is one.
  void throw_complaints() const;

 protected:
  // Reads the context's strings and starts to listen; call once, when open. Throws Error where the
  // context is less than we need.
  void describe(const std::string& backend, const std::string& device, bool debug);
  // Finds its functions, which are called from then on. Throws Error.
  void load_functions();
  // Deletes what ended elsewhere.
  void run_deletions();
  // What of it is still its own ends with it: first of all in its destructor.
  void drop_data();
  // To glDebugMessageCallback.
  static void GLAD_API_PTR collect(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                   const GLchar* message, const void* complaints);
  [[nodiscard]] ContextData* data() const { return data_.get(); }
  [[nodiscard]] std::vector<std::string>* listener() { return &complaints_; }

 private:
  [[nodiscard]] virtual bool is_bound() const = 0;
  virtual void bind() = 0;  // none is current before it
  virtual void unbind() = 0;
  [[nodiscard]] virtual GLADloadfunc loader() const = 0;

  ContextInfo info_;
  std::vector<std::string> complaints_;
  std::shared_ptr<ContextData> data_ = std::make_shared<ContextData>();
  bool has_functions_ = false;
  NativeContext callers_;  // between enter() and leave()
  ContextData* callers_data_ = nullptr;
};

// Throws Error where OpenGL reported one since the last look, ContextLostError where that is why; of full
// memory as `no_room` says it.
void throw_errors(const std::string& no_room = "the GPU's memory is full");
// Forgets what it reported.
void clear_errors() noexcept;

// Whether the GPU was reset and this thread's context is lost with all that was in it. A driver that does
// not tell (OpenGL older than 4.5, or no reset notification) never is.
[[nodiscard]] bool context_lost();

}  // namespace pinocchio::gl
