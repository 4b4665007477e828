#include "app/window/scene_loader.h"

#include <thread>
#include <utility>

#include "app/errors.h"

namespace pinocchio::app {

struct SceneLoader::Job {
  explicit Job(DrawOptions o) : options(std::move(o)) {}

  const DrawOptions options;
  std::mutex mutex;  // of what follows
  Progress progress;
  double phase_begin_s = now_s();
  News news;

  void begin_phase(std::string phase) {
    const std::scoped_lock lock(mutex);
    progress.phase = std::move(phase);
    phase_begin_s = now_s();
  }
  void fail(const std::string& line, ExitCode code) {
    begin_phase({});
    const std::scoped_lock lock(mutex);
    news.error = line;
    news.code = code;
  }

  void load() {
    begin_phase("reading " + options.scene);
    Scene read = load_scene_for(options);
    const Camera camera = camera_for(options, read);
    const std::vector<Light> lights = read.lights;
    const auto scene =
        std::make_shared<PreparedScene>(std::move(read), Sides{false, false}, options.tree, options.isa);
    const Needs needs = take_census(scene->scene);
    begin_phase("building the tree of " + std::to_string(scene->scene.mesh->triangles.size()) + " triangles");
    {
      const std::scoped_lock lock(mutex);
      news.scene = scene;
      news.needs = needs;
      news.camera = camera;
      news.lights = lights;
    }
    auto tracer =
        std::make_shared<const Tracer>(scene->scene.mesh, options.tree, options.isa, options.offset);
    begin_phase({});
    const std::scoped_lock lock(mutex);
    news.tracer = std::move(tracer);
  }

  void run() {
    try {
      load();
    } catch (const Exit& end) {
      fail(end.what(), end.code());
    } catch (const std::bad_alloc&) {
      fail(options.scene + ": out of memory; it is too large for this machine", kFailed);
    } catch (const std::exception& error) {
      fail(error.what(), kFailed);
    }
  }
};

void SceneLoader::start(const DrawOptions& options) {
  job_ = std::make_shared<Job>(options);
  // Detached: nobody waits for a scene that is no longer wanted.
  std::thread([job = job_, alive = threads_] { job->run(); }).detach();
}

SceneLoader::News SceneLoader::poll() {
  if (!job_) return {};
  News news;
  {
    const std::scoped_lock lock(job_->mutex);
    news = std::exchange(job_->news, {});
  }
  // The tree's thread only reads the scene's triangles.
  if (news.scene) news.scene->gpu.emplace(news.scene->scene);
  if (!news.error.empty() || news.tracer) job_.reset();
  return news;
}

SceneLoader::Progress SceneLoader::progress() const {
  if (!job_) return {};
  const std::scoped_lock lock(job_->mutex);
  return {job_->progress.phase, now_s() - job_->phase_begin_s};
}

}  // namespace pinocchio::app
