#pragma once

#include <glad/gl.h>

#include <string>
#include <vector>

namespace pinocchio::gl {

struct ContextInfo {
  std::string backend;  // "egl", "osmesa"
  std::string device;   // what was opened, in words
  std::string vendor, renderer, version;
  int major = 0, minor = 0;
  bool software = false;  // drawn by the processor: there is no bus to cross
};

// An OpenGL core context, 3.3 with GL_ARB_clip_control at least, that draws into framebuffer objects
// only. GL calls go to the context made current last, from that thread alone.
class Context {
 public:
  Context() = default;
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Makes it this thread's context and loads its functions.
  void make_current();
  // Lets another thread take it.
  virtual void release() = 0;

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

 private:
  virtual void bind() = 0;
  [[nodiscard]] virtual GLADloadfunc loader() const = 0;

  ContextInfo info_;
  std::vector<std::string> complaints_;
};

// Whether the GPU was reset and this thread's context is lost with all that was in it. A driver that does
// not tell (OpenGL older than 4.5, or no reset notification) never is.
[[nodiscard]] bool context_lost();

}  // namespace pinocchio::gl
