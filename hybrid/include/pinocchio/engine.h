// What frames are drawn with.
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
  std::string backend = "auto";  // OpenGL context: auto, egl, osmesa or glfw (a display's)
  std::string device{};          // EGL's device number, "software", or empty: the first that works
  int gl_threads = 0;            // of a software rasteriser; 0: its own choice
  bool gl_debug = false;         // what the driver complains about is an error
  bool gives_way = false;        // threads that trace leave the processor to the caller's: for windows
  // Where a function of OpenGL is, of a context of the caller's that is used instead of one of our own
  // (glfwGetProcAddress, eglGetProcAddress). That context must outlive the Engine, and be current on the
  // thread of each call that draws, the Engine's end among them. It may be in any state, which every call
  // gives back and callbacks find, but: no query that counts what is drawn and no conditional render may be
  // active, the names that are bound must not be marked for deletion, and errors that OpenGL has not been
  // asked for are forgotten.
  using GetProcAddress = void (*(*)(const char*))();
  GetProcAddress get_proc_address = nullptr;
};

// Owns the OpenGL context, worker threads, the tracing thread and the compiled programs; what is not needed
// is never opened. Used by one thread at a time, but for prepare(). Any number may live in a process. Each
// call makes the Engine's context current while it needs it; after the call, and in callbacks, the caller's
// is current again (EGL, GLX, OSMesa, GLFW).
class Engine {
 public:
  explicit Engine(const EngineOptions& options = {});
  // Draws in a context of the caller's, current on this thread, that outlives the Engine.
  explicit Engine(gl::Context& context, const EngineOptions& options = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // Fills in what the settings leave open, for a picture of `size` pixels of the scene: the least that draws
  // it exactly. keeps_mask: every bit of the shadow mask is wanted, seen or not. An error where they cannot
  // be. Throws NoOpenGlError where they want OpenGL and there is none.
  [[nodiscard]] Expected<Settings> resolve(const Scene& scene, glm::ivec2 size, const Settings& settings = {},
                                           bool keeps_mask = true) const;

  // The tree that frames of these settings trace in; null where they trace nothing. `only`: what all of them
  // show, for which the tree is made then; no picture depends on it. Any thread.
  [[nodiscard]] static std::shared_ptr<const Tracer> prepare(const Scene& scene, const Settings& settings,
                                                             Progress* progress = nullptr,
                                                             const View* only = nullptr);

  // One picture, waited for: resolves, prepares (the last scene's tree is kept) and averages the samples.
  // Phases "build" and "render".
  [[nodiscard]] Expected<FrameResult> render(const Scene& scene, const View& view,
                                             const Settings& settings = {}, Progress* progress = nullptr);

  // Worker threads of its own, `threads` of them (0: one a core), for work between frames. Any thread.
  [[nodiscard]] Workers& workers(int threads = 0) const;
  // Opens the OpenGL context now, where settings would need it later. Throws NoOpenGlError.
  void open_gl() const;
  // What resolve() asks of the machine: whether OpenGL runs on the tracer's own cores, where settings use it.
  // Opens the context to know, but for settings by_machine where EGL lists no hardware: then it is not
  // needed. Throws NoOpenGlError; with by_machine, no OpenGL is a software one.
  [[nodiscard]] bool gl_is_software(const Settings& settings) const;
  // Why settings by_machine found no OpenGL when gl_is_software() tried to open it; empty where it did not
  // fail.
  [[nodiscard]] const std::string& gl_failure() const;
  // Of the context; null while none is open.
  [[nodiscard]] const gl::ContextInfo* gl_info() const;
  // With gl_debug: throws what the driver complained about.
  void throw_gl_complaints() const;

  // That shaders are read from (PINOCCHIO_SHADERS); empty where they are built in.
  [[nodiscard]] const std::filesystem::path& shader_folder() const;
  // Compiles all shaders that were used so far anew, as they are in the folder now; frames that are begun
  // from now on are drawn by them. Where one is wrong, all stay as they were and the error says what. Opens
  // the context.
  [[nodiscard]] Expected<void> reload_shaders();

  struct Parts;
  // For the rooms within (hybrid/engine_parts.h).
  [[nodiscard]] Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace pinocchio
