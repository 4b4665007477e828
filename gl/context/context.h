#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/context/current.h"
#include "gl/context/functions.h"

namespace pinocchio::gl {

struct ContextInfo {
  std::string backend;  // "egl", "osmesa", "glfw"
  std::string device;   // the way that was opened, in words
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

  // Makes it this thread's context and leaves it current: for windows and tests, which have no other.
  void make_current();
  // Another thread can make it current after this.
  void release();

  // Between the two calls it is this thread's context. After them the caller's is, in its old state. If it is
  // this thread's context already, they change nothing. Throws Error.
  virtual void enter();
  virtual void leave() noexcept;

  [[nodiscard]] const ContextInfo& info() const { return info_; }

  // The driver's complaints (KHR_debug: errors, undefined behaviour, high severity) since the context was
  // opened with `debug`. Empty without.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }
  // Throws Error with the first complaint, if there is one.
  void throw_complaints() const;

 protected:
  // Reads the context's strings and starts to listen. Called once, when it is open. Throws Error where the
  // context has less than we need.
  void describe(const std::string& backend, const std::string& device, bool debug);
  // Loads the context's functions and makes them current. Throws Error.
  void load_functions();
  // Deletes the objects that ended while the context was not current.
  void run_deletions();
  // Ends the context's data, and with it the names of its objects. Every destructor calls this first.
  void drop_data();
  // For glDebugMessageCallback.
  static void GLAD_API_PTR collect(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                   const GLchar* message, const void* complaints);
  [[nodiscard]] ContextData* data() const { return data_.get(); }
  [[nodiscard]] std::vector<std::string>* listener() { return &complaints_; }

 private:
  [[nodiscard]] virtual bool is_bound() const = 0;
  virtual void bind() = 0;  // called while no context is current
  virtual void unbind() = 0;
  [[nodiscard]] virtual GLADloadfunc loader() const = 0;

  ContextInfo info_;
  std::vector<std::string> complaints_;
  std::shared_ptr<ContextData> data_ = std::make_shared<ContextData>();
  bool has_functions_ = false;
  NativeContext callers_;  // between enter() and leave()
  ContextData* callers_data_ = nullptr;
};

// Throws Error if OpenGL has reported an error since the last call, ContextLostError if the context is lost.
// Full memory is reported with the text `no_room`.
void throw_errors(const std::string& no_room = "the GPU's memory is full");
// Drops the errors that OpenGL has reported.
void clear_errors() noexcept;

// Whether the GPU was reset and this thread's context is lost with all its objects. Always false where the
// driver does not tell (OpenGL older than 4.5, or no reset notification).
[[nodiscard]] bool context_lost();

}  // namespace pinocchio::gl
