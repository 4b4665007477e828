#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>

#include "core/parallel/priority.h"
#include "core/parallel/start_thread.h"
#include "core/parallel/workers.h"
#include "gl/open.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/programs.h"
#include "hybrid/gpu/shading_passes.h"
#include "hybrid/gpu/visibility_pass.h"
#include "hybrid/settings/scene_stats.h"
#include "pinocchio/engine.h"

namespace pinocchio {

// One thread that does what it is given, in order: a frame's tracing, while its owner goes on.
class TracingThread {
 public:
  explicit TracingThread(bool gives_way)
      : thread_(start_thread<std::jthread>([this, gives_way](const std::stop_token& stop) {
          if (gives_way) give_way(kForFrames);
          run(stop);
        })) {}

  // What `job` throws is in the future. Where the thread could not be started, `job` is done at once.
  [[nodiscard]] std::future<void> post(std::function<void()> job);

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<std::packaged_task<void()>> jobs_;
  std::jthread thread_;
};

// The scene's lights as a frame of these settings has them: those that cast nothing (they reach nothing, or
// it has no shadows), the environment as it is turned, and no ambient light where that is sampled.
void settle_lights(Scene& scene, const Settings& settings);

// The passes of the GPU, compiled once.
struct GpuPasses {
  explicit GpuPasses(std::shared_ptr<Programs> of)
      : programs(std::move(of)), visibility(programs), shading(programs) {}
  std::shared_ptr<Programs> programs;
  VisibilityPass visibility;
  ShadingPasses shading;
};

struct Engine::Parts {
  explicit Parts(const EngineOptions& of) : options(of), tracing(of.gives_way) {}

  // What may touch OpenGL runs in here: the Engine's context is current meanwhile, if it has one, and the
  // caller's after it, in the state that it was in. Within itself it changes nothing. Throws OpenGlError
  // where OpenGL reported an error.
  template <class Work>
  decltype(auto) enter(const Work& work) {
    const Inside inside(*this);
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      throw_gl_errors();
    } else {
      decltype(auto) result = work();
      throw_gl_errors();
      return result;
    }
  }
  // The caller's code, in the midst of ours: it finds its own context as it left it.
  void call_out(const std::function<void()>& callers);
  // Throws what OpenGL reported since the last look.
  void throw_gl_errors() const;

  // Opens the context where there is none yet. Throws NoOpenGlError.
  [[nodiscard]] GpuPasses& gpu();
  // Where OpenGL failed: programs and meshes are sent again, should they be needed.
  void forget_gpu();
  [[nodiscard]] bool has_gpu() const { return passes != nullptr; }
  [[nodiscard]] Workers& workers(int threads);
  // The mesh's buffers on the GPU; made when first asked for, let go when nobody else has the mesh.
  [[nodiscard]] std::shared_ptr<const GpuMesh> gpu_mesh(const std::shared_ptr<const Mesh>& mesh);

  // The last scene's are kept, while its mesh is the same.
  [[nodiscard]] std::shared_ptr<const Tracer> tracer_of(const Scene& scene, const Settings& resolved,
                                                        Progress* progress = nullptr);
  [[nodiscard]] const SceneStats& stats_of(const Scene& scene);

  // Between enter's begin and end.
  struct Inside {
    explicit Inside(Parts& of);
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    Parts& parts;
  };
  void enter_context();
  void leave_context() noexcept;
  int depth = 0;       // of calls to enter
  bool is_in = false;  // the context is entered

  EngineOptions options;
  std::unique_ptr<gl::Context> own;  // outlives what was made in it
  gl::Context* context = nullptr;    // own or the caller's; null: none is open
  std::string gl_failure;            // why settings by_machine got none
  std::shared_ptr<Programs> programs;
  std::unique_ptr<GpuPasses> passes;
  std::mutex pools_mutex;
  std::map<int, Workers> pools;  // by number of threads; idle ones cost nothing
  std::map<std::shared_ptr<const Mesh>, std::shared_ptr<const GpuMesh>> meshes;
  std::shared_ptr<const Tracer> last_tracer;
  Settings last_settings;  // that it was built by
  std::shared_ptr<const Mesh> last_mesh;
  SceneStats last_stats;  // of it

  TracingThread tracing;  // last: ends first
};

}  // namespace pinocchio
