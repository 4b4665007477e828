#include "app/window/model/scene_loader.h"

#include <chrono>
#include <string_view>
#include <thread>
#include <utility>

#include "app/window/camera/framing.h"
#include "app/window/model/gltf_extensions.h"
#include "core/base/clock.h"
#include "core/parallel/start_thread.h"

namespace pinocchio::app {

// Warnings are returned: the window prints them.
SceneLoader::News SceneLoader::read(const DrawOptions& options, pinocchio::Progress& progress) {
  News news;
  DrawOptions silent = options;
  silent.quiet = true;
  Warnings warnings;
  Scene scene = load_whole(silent, warnings, &progress);
  scene.lights.insert(scene.lights.end(), options.lights.begin(), options.lights.end());
  if (!options.quiet) {
    for (const Warning& warning : warnings) news.warnings.push_back(warning.message());
    if (scene.lights.empty() && !scene.environment) news.warnings.push_back(assumed_light(scene, options));
  }
  light_if_dark(scene, silent);
  news.stats = analyze(scene);
  news.interest = bounds_of_interest(*scene.mesh);
  news.camera = camera_for(options, scene);
  news.extensions = gltf_extensions(scene.source);
  news.scene = std::move(scene);
  return news;
}

void SceneLoader::load(const DrawOptions& options) {
  start("reading " + options.scene, options.scene,
        [options](pinocchio::Progress& progress) { return read(options, progress); });
}

void SceneLoader::load_environment(const std::string& file, std::uint64_t limit_bytes) {
  start("reading " + file, file, [file, limit_bytes](pinocchio::Progress& progress) {
    News news;
    Warnings warnings;
    news.environment =
        value_or_exit(pinocchio::load_environment(file, &progress, limit_bytes, &warnings), kBadScene);
    for (const Warning& warning : warnings) news.warnings.push_back(warning.message());
    return news;
  });
}

void SceneLoader::build_tree(const Scene& scene, const Settings& settings) {
  const std::string triangles = std::to_string(scene.mesh->triangles.size());
  start("building the tree of " + triangles + " triangles", scene.source,
        [scene, settings](pinocchio::Progress& progress) {
          News news;
          news.tracer = Engine::prepare(scene, settings, &progress);
          return news;
        });
}

// Detached: nobody waits for a scene that is not wanted any more. Where no thread starts, the window waits.
void SceneLoader::start(const std::string& phase, const std::string& source, Work work) {
  cancel();
  phase_ = phase;
  source_ = source;
  begin_s_ = now_s();
  progress_ = std::make_shared<pinocchio::Progress>();
  const auto task = std::make_shared<std::packaged_task<News()>>(
      [work = std::move(work), progress = progress_] { return work(*progress); });
  news_ = task->get_future();
  auto thread = start_thread<std::thread>([task, alive = threads_] {
    lower_priority(kForFrames);  // the window's redraws come first
    (*task)();
  });
  if (thread.joinable())
    thread.detach();
  else
    (*task)();
}

void SceneLoader::cancel() {
  if (progress_) progress_->cancel();
  news_ = {};
}

SceneLoader::News SceneLoader::poll() {
  if (!news_.valid() || news_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  News news;
  try {
    return news_.get();
  } catch (const Exit& end) {
    news.error = end.what();
    news.code = end.code();
  } catch (const std::bad_alloc&) {
    news.error = source_ + ": out of memory; it is too large for this machine";
    news.code = kFailed;
  } catch (const std::exception& error) {
    news.error = error.what();
    news.code = kFailed;
  }
  return news;
}

SceneLoader::Progress SceneLoader::progress() const {
  if (!news_.valid()) return {};
  const bool of_mesh = std::string_view(progress_->phase()) == "mesh";
  return {phase_ + (of_mesh ? ": its triangles" : ""), now_s() - begin_s_, progress_->fraction()};
}

}  // namespace pinocchio::app
