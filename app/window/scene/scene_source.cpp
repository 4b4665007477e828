#include "app/window/scene/scene_source.h"

#include <utility>

namespace pinocchio::app {

SceneSource::SceneSource(Model& model, const DrawOptions& options, bool watch)
    : model_(model), options_(options), watches_(watch) {
  load(options_);
}

namespace {

// The command line's belongs to another scene, or to one that is turned otherwise.
void forget_camera_and_lights(DrawOptions& draw) {
  draw.camera.clear();
  draw.eye = draw.target = draw.up = std::nullopt;
  draw.fov_deg = draw.lens_radius = draw.focus = draw.height = std::nullopt;
  draw.projection = std::nullopt;
  draw.lights.clear();
}

}  // namespace

void SceneSource::open(const std::string& file) {
  DrawOptions draw = options_;
  draw.scene = file;
  draw.load.animation.clear();  // they are another file's
  draw.load.variant.clear();
  forget_camera_and_lights(draw);
  load(draw);
}

void SceneSource::turn_up(UpAxis axis) {
  DrawOptions draw = options_;
  draw.load.up_axis = axis;
  forget_camera_and_lights(draw);
  load(draw);
}

void SceneSource::choose_variant(const std::string& name) {
  DrawOptions draw = options_;
  draw.load.variant = name;
  load(draw);
}

void SceneSource::open_unlimited() {
  constexpr std::uint64_t kNoLimit = std::uint64_t{1} << 50;
  model_.is_over_limit = false;
  std::optional<DrawOptions> draw = std::exchange(refused_, std::nullopt);
  if (!draw) return;
  draw->load.limit_bytes = kNoLimit;
  load(*draw);
}

// A tree that is being built is dropped, and requested again afterwards.
void SceneSource::open_environment(const std::string& file) {
  if (!model_.has_scene()) return model_.messages.hint("open a scene first, then its environment");
  if (!model_.tracer) tree_settings_.reset();
  reject();
  loader_.load_environment(file, options_.load.limit_bytes);
}

// The loader does one thing at a time: a tree that is being built is dropped.
void SceneSource::load(const DrawOptions& options) {
  if (!model_.tracer) tree_settings_.reset();
  reject();
  pending_ = options;
  loader_.load(options);
}

void SceneSource::cancel() {
  loader_.cancel();
  reject();
  model_.messages.hint(!model_.has_scene() ? "nothing is open: drop a file on the window, or press F10"
                       : model_.tracer
                           ? "cancelled; the scene before stays"
                           : "cancelled; without shadows and mirrors until the scene is opened again");
}

SceneLoader::News SceneSource::poll() {
  SceneLoader::News news = loader_.poll();
  model_.loading = loader_.progress();
  if (news.error.empty()) return news;
  code_ = news.code;
  model_.messages.error("scene", news.error);
  model_.is_over_limit = pending_ && news.error.find("--load-limit") != std::string::npos;
  if (model_.is_over_limit) refused_ = pending_;
  reject();
  return news;
}

void SceneSource::accept(const Scene& scene) {
  if (pending_) options_ = *std::exchange(pending_, std::nullopt);
  tree_settings_.reset();
  if (!watches_) return;
  if (watch_ && model_.scene.source == scene.source) {
    model_.messages.news(scene.source + " was loaded again");
    watch_->follow(scene.source_files);
  } else {
    watch_.emplace(scene.source_files);
  }
}

void SceneSource::request_tree(const Settings& given) {
  Settings settings = given;
  if (model_.wants_tree && !settings.traces()) apply_preset("mode", "raytrace", settings);
  if (!settings.traces() || !loader_.progress().phase.empty()) return;
  if (tree_settings_ && same_tracer(*tree_settings_, settings)) return;
  tree_settings_ = settings;
  if (model_.scene.animation)
    model_.playback.posed_s.reset();  // each pose has a tree of its own
  else
    loader_.build_tree(model_.scene, settings);
}

}  // namespace pinocchio::app
