// Scenes that are opened, and settings that are changed.
#include <utility>

#include "app/errors.h"
#include "app/window/session.h"
#include "core/base/clock.h"
#include "core/parallel/workers.h"
#include "gl/context.h"
#include "hybrid/settings/resolve.h"

namespace pinocchio::app {

// Until it is read, the scene before stays in charge.
void Session::open(const std::string& file) {
  DrawOptions draw = options_.draw;
  draw.scene = file;
  // What the command line said of camera and lights was about another scene.
  draw.camera.clear();
  draw.eye = draw.target = draw.up = std::nullopt;
  draw.fov_deg = draw.lens_radius = draw.focus = std::nullopt;
  draw.lights.clear();
  load(draw);
}

// A tree that is being built is forgotten.
void Session::load(const DrawOptions& options) {
  if (!model_.tracer) tree_of_.reset();
  pending_ = options;
  loader_.load(options);
}

void Session::take_news() {
  SceneLoader::News news = loader_.poll();
  const bool was_loading = !model_.loading.phase.empty();
  model_.loading = loader_.progress();
  if (was_loading && model_.loading.phase.empty()) redraws_ = 3;
  if (!news.error.empty()) {
    if (!model_.has_scene()) throw Exit(news.code, news.error);
    model_.messages.error("scene", news.error);
    pending_.reset();
  }
  if (news.scene && can_draw(news.stats)) take_scene(news);
  if (news.tracer) model_.tracer = std::move(news.tracer);
}

// Where the settings cannot draw it, the verb ends, or the scene before stays.
bool Session::can_draw(const SceneStats& stats) {
  const Expected<Settings> can = resolved(wanted_settings(model_.settings), stats, false);
  if (can) return true;
  InputError error = can.error();
  error.file = options_.draw.plan_file;
  if (!model_.has_scene()) throw Exit(error.file.empty() ? kBadScene : kUsage, error.message());
  model_.messages.error("scene", error.message());
  pending_.reset();
  return false;
}

void Session::take_scene(SceneLoader::News& news) {
  const Scene& scene = *news.scene;
  const bool again = model_.scene.source == scene.source;
  renderer_.drain();
  drop_pose();
  if (pending_) options_.draw = *std::exchange(pending_, std::nullopt);
  model_.stats = news.stats;
  model_.tracer.reset();
  tree_of_.reset();
  model_.camera.set_scene(news.stats.bounds, news.interest);
  if (!again) model_.camera.set_camera(news.camera);
  first_camera_ = news.camera;
  applied_lights_ = scene.lights;
  model_.lights_changed = scene_edited_ = false;
  model_.messages.mended("scene");
  for (const std::string& warning : news.warnings) model_.messages.warning(warning);
  model_.history.clear();
  model_.zoom = {};
  window_.set_title(scene.source + " - Pinocchio");
  preferences_.add_recent(scene.source);
  model_.recent = preferences_.recent;
  if (!again) model_.files = {};  // its folder, from now on
  if (options_.watch && again && scene_watch_) {
    model_.messages.news(scene.source + " was loaded anew");
    scene_watch_->follow(scene.source_files);
  } else if (options_.watch) {
    scene_watch_.emplace(scene.source_files);
  }
  model_.scene = std::move(*news.scene);
  if (!again) model_.playback = {};
  posed_s_.reset();
  edits_.begin(edit_state());
}

void Session::take_file_changes() {
  if (scene_watch_ && scene_watch_->changed(now_s())) load(options_.draw);
  if (!shader_watch_ || !shader_watch_->changed(now_s())) return;
  if (const Expected<void> reloaded = engine_.reload_shaders()) {
    model_.messages.mended("shaders");
    model_.messages.news("the shaders were loaded anew");
  } else {
    model_.messages.error("shaders", reloaded.error().message());
  }
  redraws_ = 3;
  asked_.reset();  // the same picture is another one now
  sample_ = 0;
  accumulator_.reset();
}

Expected<Settings> Session::resolved(const Settings& wanted, const SceneStats& stats, bool keeps_mask) const {
  return resolve(wanted, stats, {picture_size(), engine_.gl_info()->software, keeps_mask});
}

// Draws by the settings from now on; until there is a tree, by the GPU alone. Where they cannot be, says why.
bool Session::try_settings(const ViewSettings& settings) {
  const bool keeps_mask = settings.buffer == BufferView::mask;
  Expected<Settings> wanted = resolved(wanted_settings(settings), model_.stats, keeps_mask);
  if (!wanted) {
    model_.messages.hint(wanted.error().message());
    return false;
  }
  want_tree(*wanted);
  model_.threads = engine_.workers(wanted->threads).count();
  if (wanted->traces() && !model_.tracer) {
    Settings raster;
    apply_preset("mode", "raster", raster);
    wanted = resolved(raster, model_.stats, false);
  }
  if (options_.budget.any() && model_.tracer) {
    keep_budget(*wanted);
    if (controller_) wanted = controller_->now().settings;
  }
  if (wanted->persistent != model_.drawn.persistent) last_ = nullptr;  // its buffers are made anew
  if (!(*wanted == model_.drawn)) model_.history.clear();              // other figures
  model_.drawn = *wanted;
  return true;
}

// Ways to draw it for less are measured, one a turn; then frames keep to the budget.
void Session::keep_budget(const Settings& exact) {
  if (!(exact == exact_)) {
    controller_.reset();
    trial_.reset();
    exact_ = exact;
    if (exact.composite == Processor::cpu || !exact.traces())
      return model_.messages.hint("--budget and --max-error are for mode hybrid, design 1");
    renderer_.drain();
    trial_ =
        std::make_unique<BudgetTrial>(engine_, exact, options_.budget, [this](const Settings& settings, int) {
          FrameRequest one = request();
          one.settings = settings;
          return one;
        });
  }
  if (!trial_) return;
  trial_->step();
  redraws_ = 1;
  model_.messages.hint(
      "measuring plans: " + std::to_string(trial_->done()) + " of " + std::to_string(trial_->count()), 1.0);
  if (trial_->done() < trial_->count()) return;
  controller_ = std::make_unique<QualityController>(trial_->front(), limits(options_.budget));
  trial_.reset();
}

// Frames trace in the old tree, where there is one, until the new one is built.
void Session::want_tree(const Settings& given) {
  Settings settings = given;
  if (wants_tree_ && !settings.traces()) apply_preset("mode", "raytrace", settings);
  if (!settings.traces() || !loader_.progress().phase.empty()) return;
  if (tree_of_ && same_tracer(*tree_of_, settings)) return;
  tree_of_ = settings;
  if (model_.scene.animation) return posed_s_.reset();  // each pose has its own
  loader_.build_tree(model_.scene, settings);
}

// The tree stays: the triangles are the same.
void Session::set_materials(std::vector<Material> materials) {
  auto mesh = std::make_shared<Mesh>(*model_.scene.mesh);
  mesh->materials = std::move(materials);
  model_.scene.mesh = std::move(mesh);
  model_.stats = analyze(model_.scene);
  scene_edited_ = true;
}

void Session::take_material() {
  if (!model_.edited_material) return;
  std::vector<Material> materials = model_.scene.mesh->materials;
  materials.at(static_cast<std::size_t>(model_.material)) =
      *std::exchange(model_.edited_material, std::nullopt);
  set_materials(std::move(materials));
}

void Session::apply_changes() {
  ViewSettings& wanted = model_.settings;
  wanted = possible(wanted);
  if (wanted.vsync != applied_.vsync) window_.set_vsync(wanted.vsync);
  if (wanted.buffer != applied_.buffer || wanted.mask_slot != applied_.mask_slot ||
      wanted.split != applied_.split || wanted.accumulate != applied_.accumulate ||
      wanted.range != applied_.range)
    again_ = true;
  if (!(wanted == applied_)) redraws_ = 3;
  if (!model_.has_scene()) {
    applied_ = wanted;
    return;
  }
  take_material();
  if (std::exchange(model_.lights_changed, false)) {
    scene_edited_ = true;
    recount_lights(model_.scene, model_.stats);
  }
  if (try_settings(wanted)) {
    applied_ = wanted;
    applied_lights_ = model_.scene.lights;
    return;
  }
  // Back to what could be drawn.
  wanted = applied_;
  model_.scene.lights = applied_lights_;
  recount_lights(model_.scene, model_.stats);
  (void)try_settings(wanted);
}

}  // namespace pinocchio::app
