// The engine that draws frames.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/open_gl_error.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

class Workers;
namespace gl {
class Context;
struct ContextInfo;
}  // namespace gl

struct EngineOptions {
  std::string backend = "auto";  // of the OpenGL context: auto, egl, osmesa or glfw (on a display)
  std::string device{};          // EGL's device number, "software", or empty: the first that works
  int gl_threads = 0;            // threads of a software rasteriser; 0: its own choice
  bool gl_debug = false;         // the driver's complaints are errors
  bool gives_way = false;        // tracing threads run at lower priority than the caller's: for windows
  // Finds the OpenGL functions of the caller's context, for example glfwGetProcAddress or eglGetProcAddress.
  // The Engine then draws in that context instead of its own. The context must outlive the Engine and be
  // current on the thread of each call that draws, and while the Engine is destroyed. It may be in any state:
  // each call restores the state, also for callbacks. The exceptions: no query that counts drawn samples or
  // primitives and no conditional render may be active, bound objects must not be marked for deletion, and
  // errors that glGetError has not yet returned are lost.
  using GetProcAddress = void (*(*)(const char*))();
  GetProcAddress get_proc_address = nullptr;
};

// Owns the OpenGL context, worker threads, the tracing thread and the compiled programs, and opens each of
// them when it is first needed. Only one thread may use it at a time, except prepare(). A process may have
// any number of Engines. Each call makes the Engine's context current while it needs it. After the call, and
// in callbacks, the caller's context is current again (EGL, GLX, OSMesa, GLFW).
class Engine {
 public:
  explicit Engine(const EngineOptions& options = {});
  // Draws in the caller's context, which is current on this thread and outlives the Engine.
  explicit Engine(gl::Context& context, const EngineOptions& options = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // Chooses the settings that are left open, for a picture of `size` pixels of the scene: the cheapest that
  // draw it exactly. keeps_mask: the shadow mask is computed also where it is not seen. An error if the
  // settings contradict each other. Throws NoOpenGlError if they need OpenGL and there is none.
  [[nodiscard]] Expected<Settings> resolve(const Scene& scene, glm::ivec2 size, const Settings& settings = {},
                                           bool keeps_mask = true) const;

  // The tree for frames with these settings; null if they trace nothing. `only`: the view of all frames, for
  // which the tree is then optimised. `before`: the tracer of another pose of the scene, whose trees are kept
  // where they still serve. No picture depends on either. Any thread.
  [[nodiscard]] static std::shared_ptr<const Tracer> prepare(const Scene& scene, const Settings& settings,
                                                             Progress* progress = nullptr,
                                                             const View* only = nullptr,
                                                             const Tracer* before = nullptr);

  // Draws one picture and waits for it: resolves, prepares (the last scene's trees are kept, also for another
  // pose of it) and averages the samples. Phases "build" and "render". Errors: those of resolve(). Throws
  // OpenGlError, and Cancelled after progress->cancel().
  [[nodiscard]] Expected<FrameResult> render(const Scene& scene, const View& view,
                                             const Settings& settings = {}, Progress* progress = nullptr);

  // The Engine's worker threads for work between frames; `threads` 0: one for each core. Any thread.
  [[nodiscard]] Workers& workers(int threads = 0) const;
  // Opens the OpenGL context now, if the settings need one later. Throws NoOpenGlError.
  void open_gl() const;
  // Whether OpenGL, if the settings use it, runs on the tracer's own cores. resolve() depends on it. Opens
  // the context to find out, except for settings by_machine if EGL lists no hardware: it is not needed then.
  // Throws NoOpenGlError, except for settings by_machine, which count a missing OpenGL as software.
  [[nodiscard]] bool gl_is_software(const Settings& settings) const;
  // The reason why gl_is_software() found no OpenGL for settings by_machine; empty: it did not
  // fail.
  [[nodiscard]] const std::string& gl_failure() const;
  // The context's; null while none is open.
  [[nodiscard]] const gl::ContextInfo* gl_info() const;
  // With gl_debug: throws the driver's first complaint.
  void throw_gl_complaints() const;

  // The folder that shaders are read from (PINOCCHIO_SHADERS). Empty: the built-in ones.
  [[nodiscard]] const std::filesystem::path& shader_folder() const;
  // Compiles all shaders that were used so far again, from the files in the folder. Frames that begin after
  // this use them. If a shader does not compile, all stay as they were and the error says why. Opens the
  // context.
  [[nodiscard]] Expected<void> reload_shaders();

  struct Parts;
  // For the folders of hybrid (hybrid/engine/engine_parts.h).
  [[nodiscard]] Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace pinocchio
