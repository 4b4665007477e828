#pragma once

#include "gl/functions.h"

namespace pinocchio::gl {

// The OpenGL context that is current on this thread, whoever made it so: by EGL, GLX or OSMesa.
class NativeContext {
 public:
  // What is current now. Libraries that the process has not loaded are not asked.
  [[nodiscard]] static NativeContext now();

  // None is current after this: OpenGL's dispatcher (libglvnd) refuses one library's while there is
  // another's.
  void release() const;
  // Current again.
  void restore() const;
  // The same context, whatever it draws to.
  [[nodiscard]] bool is_context_of(const NativeContext& other) const {
    return egl_.context == other.egl_.context && glx_.context == other.glx_.context &&
           osmesa_.context == other.osmesa_.context;
  }
  // The same context, and what it draws to.
  friend bool operator==(const NativeContext&, const NativeContext&) = default;

 private:
  struct Egl {
    unsigned api = 0;
    void *display = nullptr, *draw = nullptr, *read = nullptr, *context = nullptr;
    friend bool operator==(const Egl&, const Egl&) = default;
  };
  struct Glx {
    void *display = nullptr, *context = nullptr;
    unsigned long draw = 0, read = 0;
    friend bool operator==(const Glx&, const Glx&) = default;
  };
  struct Osmesa {
    void *context = nullptr, *buffer = nullptr;
    int width = 0, height = 0, type = 0;
    friend bool operator==(const Osmesa&, const Osmesa&) = default;
  };
  Egl egl_;
  Glx glx_;
  Osmesa osmesa_;
};

// Whatever is made current while this lives, the caller's context is current after it.
class KeepCurrent {
 public:
  KeepCurrent() = default;
  ~KeepCurrent();
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  NativeContext native_ = NativeContext::now();
  ContextData* current_ = current;
};

}  // namespace pinocchio::gl
