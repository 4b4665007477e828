#pragma once

#include "gl/context/functions.h"

namespace pinocchio::gl {

// The OpenGL context that is current on this thread, whoever made it so: by EGL, GLX or OSMesa.
class NativeContext {
 public:
  // The context that is current now. Libraries that the process has not loaded are not asked.
  [[nodiscard]] static NativeContext now();

  // No context is current after this: OpenGL's dispatcher (libglvnd) refuses a context of one library while
  // another's is current.
  void release() const;
  // Makes the context current again.
  void restore() const;
  // Whether it is the same context, whatever it draws to.
  [[nodiscard]] bool is_context_of(const NativeContext& other) const {
    return egl_.context == other.egl_.context && glx_.context == other.glx_.context &&
           osmesa_.context == other.osmesa_.context;
  }
  // Whether it is the same context and draws to the same surfaces.
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

// Makes the context that was current at construction current again at destruction.
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
