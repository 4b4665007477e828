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
#include "gl/open/open.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/programs.h"
#include "hybrid/gpu/shading_passes.h"
#include "hybrid/gpu/visibility_pass.h"
#include "hybrid/settings/scene_stats.h"
#include "pinocchio/engine.h"

namespace pinocchio {

// One thread that runs jobs in order: the tracing of frames, while the Engine's thread goes on.
class TracingThread {
 public:
  explicit TracingThread(bool gives_way)
      : thread_(start_thread<std::jthread>([this, gives_way](const std::stop_token& stop) {
          if (gives_way) lower_priority(kForFrames);
          run(stop);
        })) {}

  // Exceptions of `job` are in the future. Where the thread could not be started, `job` runs at once.
  [[nodiscard]] std::future<void> post(std::function<void()> job);

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<std::packaged_task<void()>> jobs_;
  std::jthread thread_;
};

// Changes the scene's lights to those of a frame with these settings: lights that reach nothing cast no
// shadow, nor does any without a mask; the environment is rotated; ambient light is 0 where it is sampled
// instead.
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

  // Runs `work`, which may call OpenGL: the Engine's context is current meanwhile, if it has one, and the
  // caller's afterwards, in its former state. Calls may nest. Throws OpenGlError where OpenGL reported an
  // error.
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
  // Runs a callback inside enter(): the caller's context is current meanwhile, in its former state.
  void call_out(const std::function<void()>& callers);
  // Throws the errors that OpenGL reported since the last call.
  void throw_gl_errors() const;

  // Opens the context where there is none yet. Throws NoOpenGlError.
  [[nodiscard]] GpuPasses& gpu();
  // After an OpenGL failure: programs and meshes are sent again when they are next needed.
  void forget_gpu();
  [[nodiscard]] bool has_gpu() const { return passes != nullptr; }
  [[nodiscard]] Workers& workers(int threads);
  // The mesh's buffers on the GPU; sent at the first call, released once nobody else holds the mesh.
  [[nodiscard]] std::shared_ptr<const GpuMesh> gpu_mesh(const std::shared_ptr<const Mesh>& mesh);
  // The buffers of another pose of the mesh that no frame uses any more, with what has moved; null: none.
  [[nodiscard]] std::shared_ptr<GpuMesh> moved_gpu_mesh(const Mesh& mesh);

  // The last scene's tracer and statistics are kept while its mesh is the same.
  [[nodiscard]] std::shared_ptr<const Tracer> tracer_of(const Scene& scene, const Settings& resolved,
                                                        Progress* progress = nullptr);
  [[nodiscard]] const SceneStats& stats_of(const Scene& scene);

  // The scope of enter().
  struct Inside {
    explicit Inside(Parts& of);
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    Parts& parts;
  };
  void enter_context();
  void leave_context() noexcept;
  int depth = 0;       // of nested calls to enter
  bool is_in = false;  // the context is entered

  EngineOptions options;
  std::unique_ptr<gl::Context> own;  // outlives all objects made in it
  gl::Context* context = nullptr;    // own or the caller's; null: none is open
  std::string gl_failure;            // why settings with by_machine have no context
  std::shared_ptr<Programs> programs;
  std::unique_ptr<GpuPasses> passes;
  std::mutex pools_mutex;
  std::map<int, Workers> pools;  // by number of threads; idle pools cost nothing
  std::map<std::shared_ptr<const Mesh>, std::shared_ptr<GpuMesh>> meshes;
  std::shared_ptr<const Tracer> last_tracer;
  Settings last_settings;  // of last_tracer
  std::shared_ptr<const Mesh> last_mesh;
  SceneStats last_stats;  // of last_mesh
  PoseStats pose_stats;
  double last_pose_s = 0.0;  // when the pose was made that the last record has the times of

  TracingThread tracing;  // last: ends first
};

}  // namespace pinocchio
