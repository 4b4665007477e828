#define EGL_NO_X11
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>

#include "gl/context/current.h"

#include <dlfcn.h>
#include <link.h>

#include <array>

#include "gl/context/library.h"

namespace pinocchio::gl {
namespace {

struct EglFunctions {
  static constexpr std::array kLibraries{"libEGL.so.1"};
  PFNEGLQUERYAPIPROC query_api = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLGETCURRENTDISPLAYPROC display = nullptr;
  PFNEGLGETCURRENTSURFACEPROC surface = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC context = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;

  [[nodiscard]] bool resolve(void* library) {
    return find_function(library, "eglQueryAPI", query_api) &&
           find_function(library, "eglBindAPI", bind_api) &&
           find_function(library, "eglGetCurrentDisplay", display) &&
           find_function(library, "eglGetCurrentSurface", surface) &&
           find_function(library, "eglGetCurrentContext", context) &&
           find_function(library, "eglMakeCurrent", make_current);
  }
};

// The types are written out: GL/glx.h brings X11's macros along.
struct GlxFunctions {
  static constexpr std::array kLibraries{"libGLX.so.0", "libGL.so.1"};
  void* (*display)() = nullptr;
  void* (*context)() = nullptr;
  unsigned long (*draw)() = nullptr;
  unsigned long (*read)() = nullptr;
  int (*make_current)(void* display, unsigned long draw, unsigned long read, void* context) = nullptr;

  [[nodiscard]] bool resolve(void* library) {
    return find_function(library, "glXGetCurrentDisplay", display) &&
           find_function(library, "glXGetCurrentContext", context) &&
           find_function(library, "glXGetCurrentDrawable", draw) &&
           find_function(library, "glXGetCurrentReadDrawable", read) &&
           find_function(library, "glXMakeContextCurrent", make_current);
  }
};

struct OsmesaFunctions {
  static constexpr std::array kLibraries = kOsmesaLibraries;
  void* (*context)() = nullptr;
  GLboolean (*color_buffer)(void* context, GLint* width, GLint* height, GLint* format,
                            void** buffer) = nullptr;
  void (*get_integer)(GLint name, GLint* value) = nullptr;
  GLboolean (*make_current)(void* context, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;

  [[nodiscard]] bool resolve(void* library) {
    return find_function(library, "OSMesaGetCurrentContext", context) &&
           find_function(library, "OSMesaGetColorBuffer", color_buffer) &&
           find_function(library, "OSMesaGetIntegerv", get_integer) &&
           find_function(library, "OSMesaMakeCurrent", make_current);
  }
};
constexpr GLint kOsmesaType = 0x23;

// How many libraries the process has loaded since it began.
unsigned long long loaded_libraries() {
  unsigned long long count = 0;
  const auto first = [](dl_phdr_info* info, std::size_t, void* to) {
    *static_cast<unsigned long long*>(to) = info->dlpi_adds;
    return 1;
  };
  dl_iterate_phdr(first, &count);
  return count;
}

// Null until the process has loaded the library. The handle is kept: a library with OpenGL in it is never
// unloaded. Each frame asks, and a search opens a hundred paths: what was not found is searched again only
// after the process has loaded another library.
template <class Functions>
const Functions* loaded() {
  static thread_local const Functions* found = nullptr;
  static thread_local unsigned long long searched_at = 0;
  if (found) return found;
  const unsigned long long now = loaded_libraries();
  if (now == searched_at) return nullptr;
  searched_at = now;
  for (std::size_t i = 0; !found && i < Functions::kLibraries.size(); ++i)
    if (void* const library = dlopen(Functions::kLibraries[i], RTLD_LAZY | RTLD_NOLOAD)) {
      static Functions functions;
      static const bool is_complete = functions.resolve(library);
      if (!is_complete) break;
      found = &functions;
    }
  return found;
}

}  // namespace

NativeContext NativeContext::now() {
  NativeContext n;
  if (const EglFunctions* const egl = loaded<EglFunctions>()) {
    n.egl_.api = egl->query_api();
    n.egl_.context = egl->context();
    if (n.egl_.context) {
      n.egl_.display = egl->display();
      n.egl_.draw = egl->surface(EGL_DRAW);
      n.egl_.read = egl->surface(EGL_READ);
    }
  }
  if (const GlxFunctions* const glx = loaded<GlxFunctions>(); glx && (n.glx_.context = glx->context())) {
    n.glx_.display = glx->display();
    n.glx_.draw = glx->draw();
    n.glx_.read = glx->read();
  }
  // Mesa's OSMesa takes the contexts of EGL and GLX for its own.
  if (const OsmesaFunctions* const osmesa = loaded<OsmesaFunctions>();
      osmesa && !n.egl_.context && !n.glx_.context && (n.osmesa_.context = osmesa->context())) {
    GLint format = 0;
    osmesa->color_buffer(n.osmesa_.context, &n.osmesa_.width, &n.osmesa_.height, &format, &n.osmesa_.buffer);
    osmesa->get_integer(kOsmesaType, &n.osmesa_.type);
  }
  return n;
}

void NativeContext::release() const {
  if (egl_.context)
    loaded<EglFunctions>()->make_current(egl_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (glx_.context) loaded<GlxFunctions>()->make_current(glx_.display, 0, 0, nullptr);
  if (osmesa_.context) loaded<OsmesaFunctions>()->make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

void NativeContext::restore() const {
  if (const EglFunctions* const egl = loaded<EglFunctions>(); egl && egl_.api != 0) {
    egl->bind_api(egl_.api);
    if (egl_.context) egl->make_current(egl_.display, egl_.draw, egl_.read, egl_.context);
  }
  if (glx_.context) loaded<GlxFunctions>()->make_current(glx_.display, glx_.draw, glx_.read, glx_.context);
  if (osmesa_.context)
    loaded<OsmesaFunctions>()->make_current(osmesa_.context, osmesa_.buffer, osmesa_.type, osmesa_.width,
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
