// EGL, loaded at run time: a machine without it still gets OSMesa.
#define EGL_NO_X11
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "gl/open/egl.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "gl/context/error.h"
#include "gl/context/library.h"

namespace pinocchio::gl {
namespace {

struct Egl {
  PFNEGLGETPROCADDRESSPROC get_proc_address = nullptr;
  PFNEGLGETERRORPROC get_error = nullptr;
  PFNEGLGETDISPLAYPROC get_display = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLQUERYSTRINGPROC query_string = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
  PFNEGLCREATEPBUFFERSURFACEPROC create_pbuffer = nullptr;
  PFNEGLDESTROYSURFACEPROC destroy_surface = nullptr;
  PFNEGLCREATECONTEXTPROC create_context = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC get_current_context = nullptr;
  PFNEGLQUERYAPIPROC query_api = nullptr;
  // Extensions, null where missing. The pointers are tested: some systems have these and do not list them.
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
};

template <class Function>
void resolve(Function& function, const Egl& egl, const char* name) {
  function = reinterpret_cast<Function>(egl.get_proc_address(name));
}

// The library is never unloaded: drivers leave threads and thread-local data behind that must not outlive
// their code. Null, with the loader's reason in `why`, where there is no libEGL.
const Egl* load_egl(std::string& why) {
  static std::string failure;
  static const Egl* const loaded = []() -> const Egl* {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      failure = dlerror();
      return nullptr;
    }
    static Egl egl;
    // EGL 1.4 need not find its own functions through eglGetProcAddress.
    const auto core = [library](auto& function, const char* name) {
      if (!find_function(library, name, function)) failure = std::string("libEGL.so.1 has no ") + name;
    };
    core(egl.get_proc_address, "eglGetProcAddress");
    core(egl.get_error, "eglGetError");
    core(egl.get_display, "eglGetDisplay");
    core(egl.initialize, "eglInitialize");
    core(egl.query_string, "eglQueryString");
    core(egl.bind_api, "eglBindAPI");
    core(egl.choose_config, "eglChooseConfig");
    core(egl.create_pbuffer, "eglCreatePbufferSurface");
    core(egl.destroy_surface, "eglDestroySurface");
    core(egl.create_context, "eglCreateContext");
    core(egl.destroy_context, "eglDestroyContext");
    core(egl.make_current, "eglMakeCurrent");
    core(egl.get_current_context, "eglGetCurrentContext");
    core(egl.query_api, "eglQueryAPI");
    if (!failure.empty()) return nullptr;
    resolve(egl.get_platform_display, egl, "eglGetPlatformDisplayEXT");
    resolve(egl.query_devices, egl, "eglQueryDevicesEXT");
    resolve(egl.query_device_string, egl, "eglQueryDeviceStringEXT");
    return &egl;
  }();
  why = failure;
  return loaded;
}

std::string error_name(EGLint code) {
  constexpr std::array<const char*, 15> kNames{
      "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
      "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
      "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
      "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};
  const EGLint i = code - EGL_SUCCESS;
  if (i >= 0 && i < std::ssize(kNames)) return kNames[i];
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "error 0x%x", unsigned(code));
  return text.data();
}

[[noreturn]] void fail(const Egl& egl, const std::string& call) {
  throw Error(call + " failed: " + error_name(egl.get_error()));
}

bool lists(const char* extensions, const char* name) {
  const std::size_t length = std::strlen(name);
  for (const char* at = extensions; at && (at = std::strstr(at, name)); at += length)
    if ((at == extensions || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

// `tells`: the context tells that it is lost after a reset of the GPU.
std::vector<EGLint> context_attributes(int major, int minor, bool debug, bool tells) {
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       major,
                                 EGL_CONTEXT_MINOR_VERSION,       minor,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,        debug ? EGL_TRUE : EGL_FALSE};
  if (tells)
    attributes.insert(attributes.end(),
                      {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  attributes.push_back(EGL_NONE);
  return attributes;
}

class EglContext final : public Context {
 public:
  EglContext(const Egl& egl, EGLDisplay display, const std::string& what, bool debug)
      : egl_(egl), display_(display) {
    if (display == EGL_NO_DISPLAY) fail(egl, "eglGetDisplay");
    if (!egl.initialize(display, nullptr, nullptr)) fail(egl, "eglInitialize");
    const EGLenum callers_api = egl.query_api();
    if (!egl.bind_api(EGL_OPENGL_API)) fail(egl, "eglBindAPI(EGL_OPENGL_API)");
    try {
      create(debug);
      egl.bind_api(callers_api);
      make_current();
      describe("egl", what, debug);
    } catch (...) {
      egl.bind_api(callers_api);
      destroy();
      throw;
    }
  }
  ~EglContext() override { destroy(); }

 private:
  void create(bool debug) {
    const char* extensions = egl_.query_string(display_, EGL_EXTENSIONS);
    const bool surfaceless = lists(extensions, "EGL_KHR_surfaceless_context");
    const bool no_config = surfaceless && lists(extensions, "EGL_KHR_no_config_context");
    const EGLConfig config = no_config ? nullptr : choose_config(surfaceless);
    if (!surfaceless) {
      const std::array<EGLint, 5> one_pixel{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
      surface_ = egl_.create_pbuffer(display_, config, one_pixel.data());
      if (surface_ == EGL_NO_SURFACE) fail(egl_, "eglCreatePbufferSurface");
    }
    for (const auto& [major, minor] : {std::pair(4, 5), std::pair(3, 3)})
      for (const bool tells : {true, false}) {  // many drivers do not
        context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT,
                                       context_attributes(major, minor, debug, tells).data());
        if (context_ != EGL_NO_CONTEXT) return;
      }
    fail(egl_, "eglCreateContext (OpenGL 3.3 core)");
  }

  [[nodiscard]] EGLConfig choose_config(bool surfaceless) const {
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, surfaceless ? EGL_DONT_CARE : EGL_PBUFFER_BIT,
                                       EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!egl_.choose_config(display_, wanted.data(), &config, 1, &found) || found == 0)
      fail(egl_, "eglChooseConfig");
    return config;
  }

  [[nodiscard]] bool is_bound() const override { return egl_.get_current_context() == context_; }
  void bind() override {
    const EGLenum callers_api = egl_.query_api();
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(display_, surface_, surface_, context_)) return;
    egl_.bind_api(callers_api);
    fail(egl_, "eglMakeCurrent");
  }
  void unbind() override { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  [[nodiscard]] GLADloadfunc loader() const override {
    return reinterpret_cast<GLADloadfunc>(egl_.get_proc_address);
  }

  // The display stays initialised: EGL has one for each device, and another context may use it.
  void destroy() {
    if (context_ == EGL_NO_CONTEXT && surface_ == EGL_NO_SURFACE) return;
    release();
    drop_data();
    if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
    if (surface_ != EGL_NO_SURFACE) egl_.destroy_surface(display_, surface_);
  }

  const Egl& egl_;
  EGLDisplay display_;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLContext context_ = EGL_NO_CONTEXT;
};

Candidate candidate(const Egl& egl, std::string what, std::function<EGLDisplay()> get_display) {
  Candidate c;
  c.backend = "egl";
  c.what = what;
  c.open = [&egl, what = std::move(what), get_display = std::move(get_display)](bool debug) {
    return std::make_unique<EglContext>(egl, get_display(), what, debug);
  };
  return c;
}

std::vector<Candidate> device_candidates(const Egl& egl) {
  if (!egl.query_devices || !egl.query_device_string || !egl.get_platform_display) return {};
  EGLint count = 0;
  if (!egl.query_devices(0, nullptr, &count)) return {};
  std::vector<EGLDeviceEXT> devices(count);
  if (!egl.query_devices(count, devices.data(), &count)) return {};

  std::vector<Candidate> found;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDeviceEXT device = devices[i];
    const char* extensions = egl.query_device_string(device, EGL_EXTENSIONS);
    const bool software = lists(extensions, "EGL_MESA_device_software");
    const char* file = lists(extensions, "EGL_EXT_device_drm")
                           ? egl.query_device_string(device, EGL_DRM_DEVICE_FILE_EXT)
                           : nullptr;
    const std::string kind = software ? "software" : file ? file : "hardware";
    Candidate c = candidate(egl, "EGL device " + std::to_string(i) + " (" + kind + ")", [&egl, device] {
      return egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    });
    c.device = i;
    c.software = software;
    found.push_back(std::move(c));
  }
  std::stable_partition(found.begin(), found.end(), [](const Candidate& c) { return !c.software; });
  return found;
}

}  // namespace

std::vector<Candidate> egl_candidates() {
  std::string why;
  const Egl* egl = load_egl(why);
  if (!egl) {
    Candidate missing;
    missing.backend = "egl";
    missing.what = "EGL";
    missing.open = [why](bool) -> std::unique_ptr<Context> { throw Error(why); };
    return {missing};
  }
  std::vector<Candidate> candidates = device_candidates(*egl);
  if (egl->get_platform_display)
    candidates.push_back(candidate(*egl, "EGL surfaceless", [egl] {
      return egl->get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }));
  candidates.push_back(
      candidate(*egl, "EGL default display", [egl] { return egl->get_display(EGL_DEFAULT_DISPLAY); }));
  return candidates;
}

}  // namespace pinocchio::gl
