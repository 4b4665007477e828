#include "pinocchio/engine.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "core/shade/surface.h"
#include "core/trace/view/view_params.h"
#include "gl/context/current.h"
#include "gl/context/error.h"
#include "gl/open/foreign.h"
#include "gl/open/probe.h"
#include "hybrid/engine/engine_parts.h"
#include "hybrid/frame/samples.h"
#include "hybrid/settings/resolve.h"

namespace pinocchio {

std::future<void> TracingThread::post(std::function<void()> job) {
  std::packaged_task<void()> task(std::move(job));
  std::future<void> done = task.get_future();
  if (!thread_.joinable()) {
    task();
    return done;
  }
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(task));
  }
  wake_.notify_one();
  return done;
}

// Posted jobs are run before the thread ends.
void TracingThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return !jobs_.empty(); })) {
    std::packaged_task<void()> task = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

Engine::Parts::Inside::Inside(Parts& of) : parts(of) {
  if (parts.depth == 0) parts.enter_context();
  ++parts.depth;
}

Engine::Parts::Inside::~Inside() {
  if (--parts.depth == 0) parts.leave_context();
}

void Engine::Parts::enter_context() {
  if (!context) return;
  context->enter();
  is_in = true;
}

void Engine::Parts::leave_context() noexcept {
  if (std::exchange(is_in, false)) context->leave();
}

void Engine::Parts::call_out(const std::function<void()>& callers) {
  leave_context();
  const int inner = std::exchange(depth, 0);
  const auto back = [&] {
    depth = inner;
    if (depth > 0) enter_context();
  };
  try {
    callers();
  } catch (...) {
    back();
    throw;
  }
  back();
}

void Engine::Parts::throw_gl_errors() const {
  if (is_in) gl::throw_errors();
}

namespace {

// A context of our own is probed when it is opened.
void probe_callers(gl::Context& context) {
  context.enter();
  std::string failure;
  try {
    gl::probe(context.info());
  } catch (const gl::Error& error) {
    failure = error.what();
  }
  context.leave();
  if (!failure.empty()) throw NoOpenGlError("the caller's OpenGL context cannot be used: " + failure);
}

}  // namespace

GpuPasses& Engine::Parts::gpu() {
  if (passes) return *passes;
  if (!context) {
    if (options.gl_threads > 0) setenv("LP_NUM_THREADS", std::to_string(options.gl_threads).c_str(), 1);
    {
      const gl::KeepCurrent keep;
      own = options.get_proc_address
                ? std::make_unique<gl::ForeignContext>(options.get_proc_address, options.gl_debug)
                : gl::open_context({options.backend, options.device, options.gl_debug});
      own->release();
      if (options.get_proc_address) probe_callers(*own);
    }
    context = own.get();
    if (depth > 0) enter_context();
  }
  if (!programs) programs = std::make_shared<Programs>();
  passes = std::make_unique<GpuPasses>(programs);
  return *passes;
}

void Engine::Parts::forget_gpu() {
  meshes.clear();
  passes.reset();
  if (programs) programs->forget();
}

Workers& Engine::Parts::workers(int threads) {
  const std::lock_guard lock(pools_mutex);
  return pools.try_emplace(threads, threads, options.gives_way ? kForFrames : 0).first->second;
}

std::shared_ptr<GpuMesh> Engine::Parts::moved_gpu_mesh(const Mesh& mesh) {
  const auto found = std::ranges::find_if(meshes, [&](const auto& entry) {
    const auto& [other, sent] = entry;
    return sent && other.use_count() == 1 && sent.use_count() == 1 && sent->is_alone() &&
           are_poses_of_one(*other, mesh);
  });
  if (found == meshes.end()) return nullptr;
  const auto free = meshes.extract(found);
  free.mapped()->move(*free.key()->pose(), mesh);
  return free.mapped();
}

std::shared_ptr<const GpuMesh> Engine::Parts::gpu_mesh(const std::shared_ptr<const Mesh>& mesh) {
  std::shared_ptr<GpuMesh>& found = meshes[mesh];
  if (!found) found = moved_gpu_mesh(*mesh);
  if (!found) {
    GpuMesh::Shared shared;
    for (const auto& [other, sent] : meshes) {  // another pose, or the mesh before a material was edited
      if (!sent) continue;
      if (!mesh->textures.empty() && other->textures.shares_with(mesh->textures))
        shared.textures = sent.get();
      if (has_same_geometry(*other, *mesh)) shared.geometry = sent.get();
    }
    found = std::make_shared<GpuMesh>(*mesh, shared);
  }
  std::erase_if(meshes,
                [&](const auto& entry) { return entry.first != mesh && entry.first.use_count() == 1; });
  return found;
}

std::shared_ptr<const Tracer> Engine::Parts::tracer_of(const Scene& scene, const Settings& resolved,
                                                       Progress* progress) {
  if (!last_tracer || &last_tracer->mesh() != scene.mesh.get() || !same_tracer(resolved, last_settings))
    last_tracer = prepare(scene, resolved, progress, nullptr, last_tracer.get());
  last_settings = resolved;
  return last_tracer;
}

const SceneStats& Engine::Parts::stats_of(const Scene& scene) {
  if (last_mesh == scene.mesh) {
    recount_lights(scene, last_stats);
  } else {
    last_stats = pose_stats.of(scene);
    last_mesh = scene.mesh;
  }
  return last_stats;
}

void settle_lights(Scene& scene, const Settings& settings) {
  drop_idle_casters(scene);
  settle_environment(scene, settings);
  if (settings.mask_bits > 0) return;
  for (Light& light : scene.lights) light.casts_shadow = false;
}

Engine::Engine(const EngineOptions& options) : parts_(std::make_unique<Parts>(options)) {}

Engine::Engine(gl::Context& context, const EngineOptions& options) : Engine(options) {
  parts_->context = &context;
}

Engine::~Engine() {
  try {
    parts_->enter([this] {
      parts_->meshes.clear();
      parts_->passes.reset();
      parts_->programs.reset();
    });
  } catch (const std::exception&) {
    // The context is lost, and its objects with it.
  }
}

Expected<Settings> Engine::resolve(const Scene& scene, glm::ivec2 size, const Settings& settings,
                                   bool keeps_mask) const {
  return pinocchio::resolve(settings, parts_->stats_of(scene), {size, gl_is_software(settings), keeps_mask});
}

// Pixels that BuildOptions::margin was in the chart that chose it, at 800 x 600. In a narrower view or a
// larger picture smaller nodes are worth a split.
constexpr float kMarginPixels = 7.0f;

std::shared_ptr<const Tracer> Engine::prepare(const Scene& scene, const Settings& settings,
                                              Progress* progress, const View* only, const Tracer* before) {
  if (!settings.traces()) return nullptr;
  BuildOptions options = build_options(settings);
  options.progress = progress;
  options.lights = casting_light_positions(scene);
  if (only) {
    if (!only->rays && only->camera.projection != Projection::orthographic) options.eye = only->camera.eye;
    options.margin = std::min(options.margin, kMarginPixels * glm::length(view_params(*only).step_y));
  }
  return std::make_shared<const Tracer>(scene, options, Isa{settings.isa}, settings.offset, before);
}

Expected<FrameResult> Engine::render(const Scene& scene, const View& view, const Settings& settings,
                                     Progress* progress) {
  if (const Expected<void> checked = check_camera(view.camera); !checked && !view.rays)
    return Unexpected(checked.error());
  Settings wanted = settings;
  if (!view.is_rasterisable()) draw_on_cpu(wanted);
  const Expected<Settings> resolved = resolve(scene, view.box().size(), wanted);
  if (!resolved) return Unexpected(resolved.error());
  const std::shared_ptr<const Tracer> tracer = parts_->tracer_of(scene, *resolved, progress);
  begin_phase(progress, "render", resolved->spp);
  FrameResult result;
  SampleMean mean(*resolved, [&](FrameResult&& picture) { result = std::move(picture); });
  Renderer renderer(*this, {[&](Frame& frame) { mean.add(frame); }, {}}, progress);
  submit_samples(renderer, {scene, tracer, *resolved, view}, &mean);
  renderer.drain();
  return result;
}

Workers& Engine::workers(int threads) const {
  return parts_->workers(threads);
}

void Engine::open_gl() const {
  parts_->enter([this] { (void)parts_->gpu(); });
}

bool Engine::gl_is_software(const Settings& settings) const {
  const EngineOptions& o = parts_->options;
  if (settings.by_machine && !parts_->context) {
    if (!o.get_proc_address && !gl::may_be_hardware({o.backend, o.device, o.gl_debug})) return true;
    try {
      open_gl();
    } catch (const NoOpenGlError& error) {
      parts_->gl_failure = error.what();
      return true;
    }
  }
  if (settings.uses_gpu() && !settings.coverage) open_gl();  // coverage is the CPU's
  return gl_info() && gl_info()->software;
}

const std::string& Engine::gl_failure() const {
  return parts_->gl_failure;
}

const gl::ContextInfo* Engine::gl_info() const {
  return parts_->context ? &parts_->context->info() : nullptr;
}

const std::filesystem::path& Engine::shader_folder() const {
  return *parts_->enter([this] { return &parts_->gpu().programs->folder(); });
}

Expected<void> Engine::reload_shaders() {
  return parts_->enter([this] { return parts_->gpu().programs->reload(); });
}

void Engine::throw_gl_complaints() const {
  if (parts_->context) parts_->context->throw_complaints();
}

}  // namespace pinocchio
