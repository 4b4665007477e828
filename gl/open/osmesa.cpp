#include "gl/open/osmesa.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "gl/context/error.h"
#include "gl/context/library.h"

namespace pinocchio::gl {
namespace {

// From GL/osmesa.h, which includes GL/gl.h and so cannot be included beside glad.
constexpr int kProfile = 0x33, kCoreProfile = 0x34, kMajorVersion = 0x36, kMinorVersion = 0x37;
using OsmesaContextHandle = struct osmesa_context*;

struct Osmesa {
  OsmesaContextHandle (*create_context)(const int* attributes, OsmesaContextHandle share) = nullptr;
  void (*destroy_context)(OsmesaContextHandle) = nullptr;
  GLboolean (*make_current)(OsmesaContextHandle, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
  OsmesaContextHandle (*get_current_context)() = nullptr;
  GLADapiproc (*get_proc_address)(const char* name) = nullptr;
};

// The library is never unloaded, as EGL is not (egl.cpp). Throws Error where it is missing.
const Osmesa& load_osmesa() {
  static const Osmesa osmesa = [] {
    void* library = nullptr;
    for (const char* name : kOsmesaLibraries)
      if ((library = dlopen(name, RTLD_NOW | RTLD_LOCAL))) break;
    if (!library) throw Error(dlerror());
    Osmesa functions;
    const auto resolve = [library](auto& function, const char* name) {
      if (!find_function(library, name, function)) throw Error(std::string("libOSMesa has no ") + name);
    };
    resolve(functions.create_context, "OSMesaCreateContextAttribs");
    resolve(functions.destroy_context, "OSMesaDestroyContext");
    resolve(functions.make_current, "OSMesaMakeCurrent");
    resolve(functions.get_current_context, "OSMesaGetCurrentContext");
    resolve(functions.get_proc_address, "OSMesaGetProcAddress");
    return functions;
  }();
  return osmesa;
}

// While a process ends, OSMesa frees what its contexts need, and crashes where one is used or destroyed
// later, as by the destructor of a static variable.
std::atomic<bool> is_gone = false;

// Called once OSMesa has a context, and so has registered its own function: the last one is called first.
void expect_end() {
  [[maybe_unused]] static const int registered = std::atexit([] { is_gone = true; });
}

// OSMesa crashes when it is told to draw with Vulkan.
void refuse_zink() {
  const char* const driver = std::getenv("GALLIUM_DRIVER");
  if (driver && std::string_view(driver) == "zink")
    throw Error("Mesa crashes where OSMesa draws with GALLIUM_DRIVER=zink; use --backend egl, or unset it");
}

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(bool debug) : osmesa_(load_osmesa()) {
    refuse_zink();
    for (const auto& [major, minor] : {std::pair(4, 5), std::pair(3, 3)}) {
      const std::array<int, 7> attributes{kProfile, kCoreProfile, kMajorVersion, major, kMinorVersion, minor,
                                          0};
      context_ = osmesa_.create_context(attributes.data(), nullptr);
      if (context_) break;
    }
    if (!context_) throw Error("OSMesaCreateContextAttribs (OpenGL 3.3 core) failed");
    expect_end();
    try {
      make_current();
      describe("osmesa", "OSMesa", debug);
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~OsmesaContext() override { destroy(); }

 private:
  [[nodiscard]] bool is_bound() const override {
    return !is_gone && osmesa_.get_current_context() == context_;
  }
  void bind() override {
    if (is_gone) throw Error("the process ends: OSMesa's contexts are gone");
    if (!osmesa_.make_current(context_, default_framebuffer_.data(), GL_UNSIGNED_BYTE, 1, 1))
      throw Error("OSMesaMakeCurrent failed");
  }
  void unbind() override {
    if (!is_gone) osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  }
  [[nodiscard]] GLADloadfunc loader() const override { return osmesa_.get_proc_address; }
  void destroy() {
    release();
    drop_data();
    if (!is_gone) osmesa_.destroy_context(context_);
  }

  const Osmesa& osmesa_;
  OsmesaContextHandle context_ = nullptr;
  std::array<GLubyte, 4> default_framebuffer_{};  // OSMesa needs one; we draw into framebuffer objects
};

}  // namespace

Candidate osmesa_candidate() {
  Candidate c;
  c.backend = "osmesa";
  c.what = "OSMesa";
  c.software = true;
  c.open = [](bool debug) { return std::make_unique<OsmesaContext>(debug); };
  return c;
}

}  // namespace pinocchio::gl
