#include "core/trace/tile_tracer.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "core/trace/surface.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds since the last call.
class Lap {
 public:
  double take() {
    const double now = seconds(), since = now - last_;
    last_ = now;
    return since;
  }

 private:
  double last_ = seconds();
};

std::vector<BounceLight> lights_of(const Scene& scene) {
  std::vector<BounceLight> lights;
  const std::vector<int> slots = mask_slots(scene);
  for (std::size_t i = 0; i < slots.size(); ++i) lights.push_back({light_params(scene.lights[i]), slots[i]});
  return lights;
}

int x_in_tile(std::uint32_t pixel) {
  return static_cast<int>(pixel) & (TileGrid::kTileSize - 1);
}
int y_in_tile(std::uint32_t pixel) {
  return static_cast<int>(pixel) >> kTileBits;
}

}  // namespace

SceneArrays SceneArrays::of(const Scene& scene) {
  return {scene.positions.data(),
          scene.normals.data(),
          scene.texcoords.empty() ? nullptr : scene.texcoords.data(),
          scene.triangles.data(),
          scene.triangle_materials.data(),
          scene.materials.data(),
          scene.textures.data()};
}

TilePlan::TilePlan(const TraceJob& j, const TileOutputs& o)
    : job(j), out(o), view(scaled_view(j.view, o.scale)), all_lights(lights_of(j.scene)) {
  further = {SceneArrays::of(job.scene),
             job.tracer.offset(),
             all_lights.data(),
             all_lights.size(),
             job.scene.ambient_light,
             false,
             true,
             true,
             0.0f,
             job.least_contribution,
             nullptr,
             nullptr,
             nullptr,
             nullptr};
  visible = further;
  visible.visible = true;
  visible.adds_ambient = out.color != nullptr;
  visible.adds_light = out.color || out.added;
  visible.least_light = job.least_light;
  for (const BounceLight& light : all_lights)
    if (light.slot >= 0 ? out.mask_bits > 0 : visible.adds_ambient) visible_lights.push_back(light);
  visible.lights = visible_lights.data();
  visible.light_count = visible_lights.size();
}

TileResult TileTracer::trace(const TilePlan& plan, const PixelBox& tile) {
  plan_ = &plan;
  tile_ = tile;
  counts_ = {};
  TileTimes times;
  Lap lap;
  start();
  look();
  times.primary = lap.take();
  light_visible();
  times.shadow = lap.take();
  follow();
  times.reflection = lap.take();
  write();
  times.composite = lap.take();
  return {counts_, times};
}

// The camera's rays along a Z curve: packets of any width are neighbours in the picture.
void TileTracer::start() {
  seen_.make_room(kPixels);
  const glm::ivec2 lo = tile_.lo;
  TileGrid::for_each_pixel(tile_, [&](int x, int y) {
    seen_.pixel[seen_.size++] = static_cast<std::uint32_t>((y - lo.y) << kTileBits | (x - lo.x));
  });
  plan_->job.tracer.steps().camera_rays(plan_->view, lo, seen_);
}

void TileTracer::find_hits(RayQueue& rays, int generation) {
  if (plan_->out.on_rays) plan_->out.on_rays({rays.columns(), rays.size, generation, false});
  plan_->job.tracer.closest_hits(rays.columns(), rays.size, rays.triangle);
}

void TileTracer::look() {
  const TileOutputs& out = plan_->out;
  if (out.seen) {
    for (std::size_t i = 0; i < seen_.size; ++i)
      seen_.triangle[i] = out.seen->at((tile_.lo.x + x_in_tile(seen_.pixel[i])) * out.scale,
                                       (tile_.lo.y + y_in_tile(seen_.pixel[i])) * out.scale);
  } else {
    find_hits(seen_, 0);
    counts_.primary += seen_.size;
  }
  if (out.ids)
    for (std::size_t i = 0; i < seen_.size; ++i)
      out.ids->at(tile_.lo.x + x_in_tile(seen_.pixel[i]), tile_.lo.y + y_in_tile(seen_.pixel[i])) =
          seen_.triangle[i];
  plan_->job.tracer.steps().keep_hits(seen_);
  hit_.fill(0);
  for (std::size_t i = 0; i < seen_.size; ++i) hit_[seen_.pixel[i]] = 1;
}

void TileTracer::make_room(std::size_t rays, Generation& next) {
  for (RayQueue& queue : next) queue.make_room(rays);
  for (RayQueue& queue : shadow_) queue.make_room(rays);
}

void TileTracer::bounce(Bounce step, const RayQueue& rays, Generation& next,
                        std::array<float, 3 * kPixels>& radiance) {
  step.shadow = shadow_.data();
  step.radiance = radiance.data();
  if (step.mirrored) step.mirrored = &next[0], step.refracted = &next[1];
  plan_->job.tracer.steps().bounce(step, rays);
}

void TileTracer::light_visible() {
  direct_.fill(0.0f);
  mask_.fill(0);
  make_room(seen_.size, rays_);
  Bounce step = plan_->visible;
  step.mirrored = plan_->out.depth > 0 ? rays_.data() : nullptr;
  if (!step.mirrored && step.light_count == 0 && !step.adds_ambient) return;
  bounce(step, seen_, rays_, direct_);
  fire_shadows(0, direct_);
}

// Generation by generation: every ray of one is traced before the next one starts.
void TileTracer::follow() {
  reflected_.fill(0.0f);
  for (int generation = 1; generation <= plan_->out.depth; ++generation) {
    const std::size_t rays = rays_[0].size + rays_[1].size;
    if (rays == 0) return;
    counts_.reflection += rays_[0].size;
    counts_.refraction += rays_[1].size;
    make_room(rays, next_);
    Bounce step = plan_->further;
    step.mirrored = generation < plan_->out.depth ? next_.data() : nullptr;
    for (RayQueue& queue : rays_) {
      find_hits(queue, generation);
      plan_->job.tracer.steps().keep_hits(queue);
      bounce(step, queue, next_, reflected_);
    }
    fire_shadows(generation, reflected_);
    std::swap(rays_, next_);
  }
}

void TileTracer::fire_shadows(int generation, std::array<float, 3 * kPixels>& radiance) {
  const bool visible = generation == 0, adds = !visible || plan_->visible.adds_light;
  for (const BounceLight& light : plan_->all_lights) {
    if (light.slot < 0) continue;
    const RayQueue& queue = shadow_[static_cast<std::size_t>(light.slot)];
    if (queue.size == 0) continue;
    if (blocked_.size() < queue.size + kQueuePad) blocked_.resize(2 * queue.size + kQueuePad);
    const float reach = light.params.kind == shared::kLightDirectional ? kInfinity : 1.0f;
    if (plan_->out.on_rays) plan_->out.on_rays({queue.columns(reach), queue.size, generation, true});
    plan_->job.tracer.occluded(queue.columns(reach), queue.size, blocked_.data());
    counts_.shadow += queue.size;
    for (std::size_t i = 0; i < queue.size; ++i) {
      if (blocked_[i]) continue;
      const std::uint32_t pixel = queue.pixel[i];
      if (visible) mask_[pixel] |= static_cast<std::uint8_t>(1u << light.slot);
      if (adds)
        for (std::size_t c = 0; c < 3; ++c) radiance[3 * pixel + c] += queue.light[c][i];
    }
  }
}

void TileTracer::write() {
  const TileOutputs& out = plan_->out;
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y) {
    const auto row = static_cast<std::size_t>(y - tile_.lo.y) << kTileBits;
    const auto width = static_cast<std::size_t>(tile_.size().x);
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t pixel = row + i;
      const int x = tile_.lo.x + static_cast<int>(i);
      const glm::vec3 reflected(reflected_[3 * pixel], reflected_[3 * pixel + 1], reflected_[3 * pixel + 2]);
      const glm::vec3 direct(direct_[3 * pixel], direct_[3 * pixel + 1], direct_[3 * pixel + 2]);
      if (out.reflection) out.reflection->at(x, y) = reflected;
      if (out.color) out.color->at(x, y) = glm::vec4(direct + reflected, hit_[pixel] ? 1.0f : 0.0f);
      if (out.added) out.added->at(x, y) += direct + reflected;
    }
    if (out.mask) out.mask->set_row(tile_.lo.x, y, std::span(mask_).subspan(row, width));
  }
}

}  // namespace pinocchio
