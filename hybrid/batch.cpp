#include "pinocchio/batch.h"

#include <algorithm>
#include <cassert>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "core/parallel/start_thread.h"
#include "core/trace/tiles/trace_frames.h"
#include "hybrid/engine/engine_parts.h"
#include "hybrid/frame/lines.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/conversion.h"
#include "pinocchio/layers.h"

namespace pinocchio {
namespace {

// Whether the tile queue can draw it: the CPU alone, every pixel with a sample of its own.
bool fits_tile_queue(const Settings& s) {
  return !s.uses_gpu() && s.mask_scale == 1 && s.reflection_scale == 1 && s.max_noise == 0.0f && !s.denoise &&
         !(s.average_layers && s.spp > 1);
}

RayCounts draw_tiles(Engine::Parts& engine, const Scene& scene, const std::shared_ptr<const Tracer>& tracer,
                     std::span<const Camera> cameras, glm::ivec2 size, const Settings& s,
                     const FrameArrays& to, Progress* progress, std::span<const MotionTo> motion) {
  Scene lit = scene;
  settle_lights(lit, s);
  FramesJob job{lit, *tracer, engine.workers(s.threads), cameras, size};
  job.spp = s.spp;
  if (s.reflects()) {
    job.outputs.depth = s.depth;
    job.outputs.indirect = s.indirect;
    job.outputs.environment_light = true;
  }
  job.outputs.mask_bits = mask_bits_of(s, lit);
  job.outputs.coverage = s.coverage;
  job.options = trace_options(s, {});
  job.filter = s.pixel_filter;
  job.progress = progress;
  job.motion = motion;
  return trace_frames(job, to);
}

RayCounts draw_frames(Engine& engine, FrameRequest request, std::span<const Camera> cameras,
                      const FrameArrays& to, Progress* progress, std::span<const MotionTo> motion) {
  RayCounts rays;
  std::size_t pixels = 0, frames = 0;  // written
  SampleMean mean(request.settings, [&](FrameResult&& frame) {
    if (!motion.empty()) frame.motion = motion[frames];
    write_layers(frame, to, pixels);
    ++frames;
    pixels += frame.ids.pixels().size();
  });
  Renderer renderer(
      engine,
      {[&](Frame& frame) { mean.add(frame); }, [&](const FrameRecord& record) { rays += record.rays; }},
      progress);
  for (const Camera& camera : cameras) {
    request.view.camera = camera;
    submit_samples(renderer, request, &mean);
  }
  renderer.drain();
  return rays;
}

// The settings for these cameras, of `pictures` pictures in all.
Expected<Settings> resolve_for(Engine& engine, const Scene& scene, std::span<const Camera> cameras,
                               std::size_t pictures, glm::ivec2 size, const Settings& settings) {
  for (const Camera& camera : cameras)
    if (const Expected<void> checked = check_camera(camera); !checked) return Unexpected(checked.error());
  Settings wanted = settings;
  if (!std::ranges::all_of(cameras, &Camera::is_rasterisable)) draw_on_cpu(wanted);
  wanted.exchange.fill(settings.uses_gpu() && pictures > 1 ? Exchange::pipelined : Exchange::sync);
  return engine.resolve(scene, size, wanted);
}

RayCounts draw(Engine& engine, const FrameRequest& request, std::span<const Camera> cameras,
               const FrameArrays& to, Progress* progress, std::span<const MotionTo> motion) {
  if (fits_tile_queue(request.settings))
    return draw_tiles(engine.parts(), request.scene, request.tracer, cameras, request.view.size,
                      request.settings, to, progress, motion);
  return draw_frames(engine, request, cameras, to, progress, motion);
}

// The arrays from the pixel `pixels` on.
FrameArrays advanced(FrameArrays to, std::size_t pixels) {
  for (const LayerRow& row : kLayers)
    std::visit(
        [&](auto member) {
          if constexpr (!std::is_same_v<decltype(member), std::monostate>)
            if (to.*member) to.*member += pixels * (row.layer == Layer::mask ? to.mask_bytes : 1);
        },
        row.array.values);
  return to;
}

// Neighbouring pictures of one pose.
std::vector<std::span<const PosedPicture>> runs_of(std::span<const PosedPicture> pictures) {
  std::vector<std::span<const PosedPicture>> runs;
  const auto same_pose = [](const PosedPicture& a, const PosedPicture& b) {
    return a.pose.data() == b.pose.data() && a.pose.size() == b.pose.size();
  };
  for (std::size_t i = 0, begin = 0; i < pictures.size(); ++i) {
    if (i + 1 < pictures.size() && same_pose(pictures[i], pictures[i + 1])) continue;
    runs.push_back(pictures.subspan(begin, i + 1 - begin));
    begin = i + 1;
  }
  return runs;
}

struct MadePose {
  Scene scene;
  std::shared_ptr<const Tracer> tracer;  // null: nothing is traced
};

// Makes poses in their order, one of them ahead on a thread of its own.
class PoseMaker {
 public:
  // `settings`: resolved for any of the poses.
  PoseMaker(const Scene& scene, std::vector<std::span<const NodeTransform>> poses, Settings settings,
            std::shared_ptr<const Tracer> before, Progress* progress)
      : scene_(scene),
        poses_(std::move(poses)),
        settings_(std::move(settings)),
        before_(std::move(before)),
        progress_(progress) {
    begin();
  }
  ~PoseMaker() { progress_.cancel(); }  // the future waits
  PoseMaker(const PoseMaker&) = delete;
  PoseMaker& operator=(const PoseMaker&) = delete;

  // The next pose, while the one behind it is begun; nothing: there is none left.
  [[nodiscard]] std::optional<Expected<MadePose>> next() {
    if (!next_.valid()) return std::nullopt;
    Expected<MadePose> made = next_.get();
    begin();
    return made;
  }

 private:
  void begin() {
    if (begun_ == poses_.size()) return;
    next_ = run_aside(0, [this, pose = poses_[begun_++]] { return make(pose); });
  }
  Expected<MadePose> make(std::span<const NodeTransform> pose) {
    throw_if_cancelled(&progress_);
    Expected<Scene> made = pose.empty() ? Expected<Scene>(scene_) : posed(scene_, pose);
    if (!made) return Unexpected(made.error());
    before_ = Engine::prepare(*made, settings_, &progress_, nullptr, before_.get());
    return MadePose{std::move(*made), before_};
  }

  const Scene& scene_;
  const std::vector<std::span<const NodeTransform>> poses_;
  const Settings settings_;
  std::shared_ptr<const Tracer> before_;
  Progress progress_;
  std::size_t begun_ = 0;
  std::future<Expected<MadePose>> next_;
};

std::vector<Camera> cameras_of(const Scene& scene, std::span<const PosedPicture> pictures) {
  std::vector<Camera> cameras;
  for (const PosedPicture& picture : pictures) {
    const auto* const own = std::get_if<Camera>(&picture.camera);
    cameras.push_back(own ? *own : scene.cameras.at(std::get<std::size_t>(picture.camera)));
  }
  return cameras;
}

// Where each picture's motion leads: to the next one's pose and camera. `next`: the next run's pose.
std::vector<MotionTo> motion_to_next(const Scene& scene, const std::vector<Camera>& cameras,
                                     const MadePose* next,
                                     const std::vector<std::span<const PosedPicture>>& runs,
                                     std::size_t run) {
  std::vector<MotionTo> motion;
  for (std::size_t i = 1; i < cameras.size(); ++i) motion.push_back({scene.mesh, cameras[i]});
  if (next)
    motion.push_back({next->scene.mesh, cameras_of(next->scene, runs[run + 1].first(1)).front()});
  else
    motion.push_back({scene.mesh, cameras.back()});
  return motion;
}

}  // namespace

Expected<RayCounts> render_many(Engine& engine, const Scene& scene, std::span<const Camera> cameras,
                                glm::ivec2 size, const Settings& settings, const FrameArrays& to,
                                Progress* progress, std::span<const MotionTo> motion) {
  if (cameras.empty()) return RayCounts{};
  assert(motion.empty() || motion.size() == cameras.size());
  const Expected<Settings> resolved = resolve_for(engine, scene, cameras, cameras.size(), size, settings);
  if (!resolved) return Unexpected(resolved.error());
  const std::shared_ptr<const Tracer> tracer = engine.parts().tracer_of(scene, *resolved, progress);
  begin_phase(progress, "render", as_double(cameras.size()) * resolved->spp);
  return draw(engine, {scene, tracer, *resolved, {.camera = cameras.front(), .size = size}}, cameras, to,
              progress, motion);
}

Expected<RayCounts> render_many(Engine& engine, const Scene& scene, std::span<const PosedPicture> pictures,
                                glm::ivec2 size, const Settings& settings, const FrameArrays& to,
                                Progress* progress) {
  if (pictures.empty()) return RayCounts{};
  const auto resolve = [&](const Scene& of, std::span<const Camera> cameras) {
    return resolve_for(engine, of, cameras, pictures.size(), size, settings);
  };
  const Expected<Settings> first = resolve(scene, cameras_of(scene, pictures));
  if (!first) return Unexpected(first.error());
  begin_phase(progress, "render", as_double(pictures.size()) * first->spp);
  const std::vector<std::span<const PosedPicture>> runs = runs_of(pictures);
  std::vector<std::span<const NodeTransform>> poses;
  for (const auto& run : runs) poses.push_back(run.front().pose);
  Engine::Parts& parts = engine.parts();
  PoseMaker maker(scene, std::move(poses), *first, parts.last_tracer, progress);
  std::optional<Expected<MadePose>> pose = maker.next();
  RayCounts rays;
  std::size_t pixels = 0;  // written
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (!*pose) return Unexpected(pose->error());
    auto& [posed_scene, tracer] = **pose;
    std::optional<Expected<MadePose>> next;
    if (to.motion) next = maker.next();
    if (next && !*next) return Unexpected(next->error());
    const std::vector<Camera> cameras = cameras_of(posed_scene, runs[run]);
    const Expected<Settings> resolved = resolve(posed_scene, cameras);
    if (!resolved) return Unexpected(resolved.error());
    if (!same_tracer(*resolved, *first) || (resolved->traces() && !tracer))
      tracer = Engine::prepare(posed_scene, *resolved, progress);
    parts.last_tracer = tracer;
    parts.last_settings = *resolved;
    std::vector<MotionTo> motion;
    if (to.motion) motion = motion_to_next(posed_scene, cameras, next ? &**next : nullptr, runs, run);
    rays += draw(engine, {posed_scene, tracer, *resolved, {.camera = cameras.front(), .size = size}}, cameras,
                 advanced(to, pixels), progress, motion);
    pixels += cameras.size() * as_size(size.x) * as_size(size.y);
    pose = next ? std::move(next) : maker.next();
  }
  return rays;
}

}  // namespace pinocchio
