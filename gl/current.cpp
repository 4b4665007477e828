#define EGL_NO_X11
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>

#include "gl/current.h"

#include <dlfcn.h>

#include <initializer_list>

namespace pinocchio::gl {
namespace {

// One of the process, where it has it. The handle is kept: a library with OpenGL in it is never unloaded.
void* loaded(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (void* const library = dlopen(name, RTLD_LAZY | RTLD_NOLOAD)) return library;
  return nullptr;
}

template <class Function>
void resolve(Function& function, void* library, const char* name) {
  function = reinterpret_cast<Function>(dlsym(library, name));
}

struct EglFunctions {
  PFNEGLQUERYAPIPROC query_api = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLGETCURRENTDISPLAYPROC display = nullptr;
  PFNEGLGETCURRENTSURFACEPROC surface = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC context = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;
};

// Of GL/glx.h, which brings X11's macros along.
struct GlxFunctions {
  void* (*display)() = nullptr;
  void* (*context)() = nullptr;
  unsigned long (*draw)() = nullptr;
  unsigned long (*read)() = nullptr;
  int (*make_current)(void* display, unsigned long draw, unsigned long read, void* context) = nullptr;
};

struct OsmesaFunctions {
  void* (*context)() = nullptr;
  GLboolean (*color_buffer)(void* context, GLint* width, GLint* height, GLint* format,
                            void** buffer) = nullptr;
  void (*get_integer)(GLint name, GLint* value) = nullptr;
  GLboolean (*make_current)(void* context, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
};
constexpr GLint kOsmesaType = 0x23;

// Null until the process has the library; then for good.
template <class Functions>
const Functions* once_loaded(const Functions* (*find)()) {
  static thread_local const Functions* found = nullptr;
  if (!found) found = find();
  return found;
}

const EglFunctions* find_egl() {
  void* const library = loaded({"libEGL.so.1"});
  if (!library) return nullptr;
  static const EglFunctions egl = [library] {
    EglFunctions f;
    resolve(f.query_api, library, "eglQueryAPI");
    resolve(f.bind_api, library, "eglBindAPI");
    resolve(f.display, library, "eglGetCurrentDisplay");
    resolve(f.surface, library, "eglGetCurrentSurface");
    resolve(f.context, library, "eglGetCurrentContext");
    resolve(f.make_current, library, "eglMakeCurrent");
    return f;
  }();
  return egl.query_api && egl.bind_api && egl.display && egl.surface && egl.context && egl.make_current
             ? &egl
             : nullptr;
}

const GlxFunctions* find_glx() {
  void* const library = loaded({"libGLX.so.0", "libGL.so.1"});
  if (!library) return nullptr;
  static const GlxFunctions glx = [library] {
    GlxFunctions f;
    resolve(f.display, library, "glXGetCurrentDisplay");
    resolve(f.context, library, "glXGetCurrentContext");
    resolve(f.draw, library, "glXGetCurrentDrawable");
    resolve(f.read, library, "glXGetCurrentReadDrawable");
    resolve(f.make_current, library, "glXMakeContextCurrent");
    return f;
  }();
  return glx.display && glx.context && glx.draw && glx.read && glx.make_current ? &glx : nullptr;
}

const OsmesaFunctions* find_osmesa() {
  void* const library = loaded({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
  if (!library) return nullptr;
  static const OsmesaFunctions osmesa = [library] {
    OsmesaFunctions f;
    resolve(f.context, library, "OSMesaGetCurrentContext");
    resolve(f.color_buffer, library, "OSMesaGetColorBuffer");
    resolve(f.get_integer, library, "OSMesaGetIntegerv");
    resolve(f.make_current, library, "OSMesaMakeCurrent");
    return f;
  }();
  return osmesa.context && osmesa.color_buffer && osmesa.get_integer && osmesa.make_current ? &osmesa
                                                                                            : nullptr;
}

}  // namespace

NativeContext NativeContext::now() {
  NativeContext n;
  if (const EglFunctions* const egl = once_loaded(find_egl)) {
    n.egl_.api = egl->query_api();
    n.egl_.context = egl->context();
    if (n.egl_.context) {
      n.egl_.display = egl->display();
      n.egl_.draw = egl->surface(EGL_DRAW);
      n.egl_.read = egl->surface(EGL_READ);
    }
  }
  if (const GlxFunctions* const glx = once_loaded(find_glx); glx && (n.glx_.context = glx->context())) {
    n.glx_.display = glx->display();
    n.glx_.draw = glx->draw();
    n.glx_.read = glx->read();
  }
  // Mesa's takes the others' contexts for its own.
  if (const OsmesaFunctions* const osmesa = once_loaded(find_osmesa);
      osmesa && !n.egl_.context && !n.glx_.context && (n.osmesa_.context = osmesa->context())) {
    GLint format = 0;
    osmesa->color_buffer(n.osmesa_.context, &n.osmesa_.width, &n.osmesa_.height, &format, &n.osmesa_.buffer);
    osmesa->get_integer(kOsmesaType, &n.osmesa_.type);
  }
  return n;
}

void NativeContext::release() const {
  if (egl_.context)
    once_loaded(find_egl)->make_current(egl_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (glx_.context) once_loaded(find_glx)->make_current(glx_.display, 0, 0, nullptr);
  if (osmesa_.context) once_loaded(find_osmesa)->make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

void NativeContext::restore() const {
  if (const EglFunctions* const egl = once_loaded(find_egl); egl && egl_.api != 0) {
    egl->bind_api(egl_.api);
    if (egl_.context) egl->make_current(egl_.display, egl_.draw, egl_.read, egl_.context);
  }
  if (glx_.context) once_loaded(find_glx)->make_current(glx_.display, glx_.draw, glx_.read, glx_.context);
  if (osmesa_.context)
    once_loaded(find_osmesa)
        ->make_current(osmesa_.context, osmesa_.buffer, static_cast<GLenum>(osmesa_.type), osmesa_.width,
                       osmesa_.height);
}

KeepCurrent::~KeepCurrent() {
  if (const NativeContext now = NativeContext::now(); !(now == native_)) {
    now.release();
    native_.restore();
  }
  current = current_;
}

}  // namespace pinocchio::gl
