#include "app/run/drawing.h"

#include <cstdio>
#include <cstdlib>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "gl/context/context.h"

namespace pinocchio::app {
namespace {

EngineOptions engine_options(const DrawOptions& options) {
  EngineOptions engine = options.engine;
  engine.gl_debug = std::getenv("PINOCCHIO_GL_DEBUG") != nullptr;
  return engine;
}

Settings with_usual(Settings settings, Exchange usual) {
  settings.exchange.fill(usual);
  return settings;
}

}  // namespace

void require_rasterisable(const Camera& camera, const std::string& what) {
  if (!camera.is_rasterisable())
    throw Exit(kUsage, what + " needs OpenGL, which cannot draw " + kDrawnByRaysAlone +
                           "; give another --projection or --camera");
}

Drawing::Drawing(const DrawOptions& options, Scene scene, Exchange usual, bool keeps_mask, bool any_settings,
                 const std::optional<Camera>& only)
    : options_(options),
      part_(part_of(options)),
      keeps_mask_(keeps_mask),
      engine_(engine_options(options)),
      scene_(std::move(scene)) {
  drop_idle_casters(scene_);
  stats_ = analyze(scene_);
  needs_rays_ = !camera_for(options_, scene_).is_rasterisable();
  if (any_settings) engine_.open_gl();
  if (!needs_rays_) software_gl_ = engine_.gl_is_software(options.settings);
  if (!options.quiet && !engine_.gl_failure().empty())
    print_warning(one_line(engine_.gl_failure()) + ": the CPU draws alone (--mode auto)");
  Expected<Settings> resolved = resolve(with_usual(options.settings, usual));
  if (!resolved) {
    InputError error = resolved.error();
    error.file = options.plan_file;
    Settings given = with_usual(options.settings, usual), drawn = given;
    if (needs_rays_) draw_on_cpu(drawn);
    if (!broken_rule(given) && broken_rule(drawn))
      error.what += std::string(" (the CPU alone draws ") + kDrawnByRaysAlone + ")";
    throw Exit(options.plan_file.empty() && !broken_rule(drawn) ? kBadScene : kUsage, error.message());
  }
  settings_ = *resolved;
  if (!options.quiet && !options.plan.empty())  // settings that are given one by one are known
    for (const std::string& line : losses(settings_, stats_)) print_warning(options.plan + ": " + line);
  if (!options.quiet && settings_.background.value.is_transparent() && stats_.blends && !settings_.coverage)
    print_warning(
        "the background is transparent, but surfaces that blend have alpha 1: only the CPU drawing alone "
        "counts what they let through (--mode raytrace)");
  if (!options.quiet && stats_.studio && !settings_.shadow_catcher.given && settings_.reflects() &&
      settings_.visibility == Processor::gpu && settings_.composite == Processor::cpu)
    print_warning(
        "the studio's ground shadow is left out: it travels with mirrored light, which design 2 does not "
        "send (--design 1)");
  if (!options.quiet && settings_.background_blur > 0.0f &&
      !backdrop_of(scene_, settings_.background).picture)
    print_warning(
        "--background-blur changes nothing: neither an environment nor the studio is behind the scene "
        "(--environment FILE or --background studio)");
  if (!options.quiet && !any_settings) advise(with_usual(options.settings, usual));
  if (scene_.animation)
    poses_.emplace(scene_, &run_progress());
  else if (any_settings || (settings_.traces() && !options.precise)) {
    const View view{only.value_or(Camera{}), options.size, part_};
    tracer_ = Engine::prepare(scene_, settings_, &run_progress(), only ? &view : nullptr);
  }
}

void Drawing::advise(Settings automatic) const {
  if (!software_gl_ || !settings_.uses_gpu() || !settings_.traces()) return;
  automatic.by_machine = true;
  const Expected<Settings> other = resolve(automatic);
  if (!other || other->uses_gpu()) return;
  std::fprintf(stderr,
               "pinocchio: OpenGL is software here (%s); --mode auto would draw with the CPU alone, %s\n",
               engine_.gl_info()->renderer.c_str(), kGainOverSoftwareGl);
}

Expected<Settings> Drawing::resolve(const Settings& wanted) const {
  return pinocchio::resolve(wanted, stats_, {part_.size(), software_gl_, keeps_mask_, needs_rays_});
}

FrameRequest Drawing::request(const Settings& settings, const CameraFrame& frame, const CameraFrame* next) {
  const View view{frame.camera, options_.size, part_};
  if (!poses_) return {scene_, tracer_, settings, view};
  const std::optional<double> next_s = next ? std::optional(next->time_s) : std::nullopt;
  PoseAhead::Pose pose = value_or_exit(poses_->at(frame.time_s, settings, next_s), kBadScene);
  return {std::move(pose.scene), std::move(pose.tracer), settings, view};
}

FrameRequest Drawing::untraced_request(const CameraFrame& frame) const {
  return {value_or_exit(at_time(scene_, frame.time_s), kBadScene),
          nullptr,
          settings_,
          {frame.camera, options_.size, part_}};
}

}  // namespace pinocchio::app
