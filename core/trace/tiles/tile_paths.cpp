// The rays that a tile's points spawn: shadow rays, mirrored and refracted rays, those to the environment and
// to other surfaces.
#include <algorithm>
#include <cassert>

#include "core/trace/rays/passed_surfaces.h"
#include "core/trace/tiles/tile_tracer.h"

namespace pinocchio {

// Follows the rays that the camera's rays spawned, then those of matt surfaces, bounce by bounce.
void TileTracer::follow() {
  std::size_t rays = next_diffuse_.size;
  for (const RayQueue& queue : rays_) rays += queue.size;
  if (rays > 0) begin_light();
  follow_mirrors(0);
  for (int bounce = 1; bounce <= plan_->out.indirect && next_diffuse_.size > 0; ++bounce) {
    follow_diffuse(bounce);
    follow_mirrors(bounce);
  }
}

// Follows a bounce's rays between matt surfaces. The environment's light along them was added where they
// start.
void TileTracer::follow_diffuse(int bounce_count) {
  std::swap(diffuse_, next_diffuse_);
  counts_.indirect += diffuse_.size;
  const int generation = generation_of(bounce_count, 0);
  next_diffuse_.make_room(0, extra_columns());
  make_room(diffuse_.size, rays_);
  Bounce step = plan_->further;
  step.mirrored = step.straight = plan_->out.depth > 0 ? rays_.data() : nullptr;
  step.diffuse = bounce_count < plan_->out.indirect ? &next_diffuse_ : nullptr;
  step.of_matt = true;
  find_hits(diffuse_, generation);
  plan_->job.tracer.steps().keep_hits(diffuse_);
  bounce(step, generation, diffuse_, rays_, reflected_.data());
  light_points(step, generation, {&diffuse_, 1}, plan_->further_lights, reflected_.data());
}

// Each has random numbers of its own. Those that only go straight on have them behind all others.
int TileTracer::generation_of(int bounce_count, int step_count) const {
  const int depth = plan_->out.depth;
  if (step_count <= depth) return bounce_count * (depth + 1) + step_count;
  return (plan_->out.indirect + 1) * (depth + 1) + bounce_count * kStraightBeyond + step_count - depth - 1;
}

// Traces generation by generation: all rays of one before the next. The last generations only go straight on.
void TileTracer::follow_mirrors(int bounce_count) {
  const int most = plan_->out.depth > 0 ? plan_->out.depth + kStraightBeyond : 0;
  for (int step_count = 1; step_count <= most; ++step_count) {
    const int generation = generation_of(bounce_count, step_count);
    const std::size_t mirrored = rays_[kMirrored].size,
                      through =
                          rays_[kRefracted].size + rays_[kStraight].size + rays_[kStraightFromCamera].size;
    const std::size_t rays = mirrored + through;
    if (rays == 0) return;
    counts_.reflection += mirrored;
    counts_.refraction += through;
    make_room(rays, next_);
    Bounce step = plan_->further;
    step.mirrored = step_count < plan_->out.depth ? next_.data() : nullptr;
    step.straight = step_count < most ? next_.data() : nullptr;
    step.diffuse = bounce_count < plan_->out.indirect ? &next_diffuse_ : nullptr;
    if (bounce_count == 0 && plan_->beyond) {
      step.sampled = 2 * kSampledPixels;
      step.points = &points_[kPixels];
    }
    for (RayQueue& queue : rays_) {
      const bool of_camera = &queue == &rays_[kStraightFromCamera];
      if (of_camera && queue.size == 0) continue;
      find_hits(queue, generation, of_camera);
      if (of_camera)
        see_background(queue);
      else if (plan_->environment)
        plan_->job.tracer.steps().add_environment(*plan_->environment, plan_->further.environment != nullptr,
                                                  queue, &reflected_[0].x);
      plan_->job.tracer.steps().keep_hits(queue);
      bounce(step, generation, queue, next_, reflected_.data(), of_camera);
    }
    light_points(step, generation, rays_, plan_->further_lights, reflected_.data());
    std::swap(rays_, next_);
  }
}

// Fires the step's shadow rays. Then lights its points by each group of lights after the first.
void TileTracer::light_points(const Bounce& step, int generation, std::span<const RayQueue> points,
                              const std::vector<LightGroup>& groups, glm::vec4* radiance) {
  for (const LightGroup& group : groups) {
    glm::vec4* const to = group.in_reflection ? reflected_.data() : radiance;
    if (&group != &groups.front()) {
      std::size_t count = 0;
      for (const RayQueue& queue : points) count += queue.size;
      make_room_for_shadows(count);
      for (const RayQueue& queue : points) bounce(lights_alone(group, step), generation, queue, next_, to);
    }
    fire_shadows(group, generation, to);
    fire_at_environment(generation);
  }
}

void TileTracer::fire_shadows(const LightGroup& group, int generation, glm::vec4* radiance) {
  const bool visible = generation == 0, adds = !visible || plan_->visible.adds_light || group.in_reflection;
  std::uint8_t* const mask = visible ? &mask_[as_size(group.byte) * kPixels] : nullptr;
  for (const BounceLight& light : group.lights) {
    if (light.slot < 0) continue;
    const RayQueue &queue = shadow_[as_size(light.queue)], &clear = clear_[as_size(light.queue)];
    counts_.shadow += clear.size;
    if (queue.size > 0) find_blocked(light, queue, generation);
    if (visible) {  // without a branch, which would be predicted badly at the edges of shadows
      for (std::size_t i = 0; i < queue.size; ++i)
        mask[queue.pixel[i]] |= static_cast<std::uint8_t>(((blocked_[i] & 1u) ^ 1u) << light.queue);
      for (std::size_t i = 0; i < clear.size; ++i)
        mask[clear.pixel[i]] |= static_cast<std::uint8_t>(1u << light.queue);
    }
    const bool apart = visible && plan_->out.sampled && light.has_size;
    glm::vec4* const of_lamps = &reflected_[kSampledPixels + kLampPixels];
    if (plan_->tints && queue.size > 0) add_light_through_glass(queue, apart ? of_lamps : reflected_.data());
    if (!adds && !apart) continue;
    glm::vec4* const to = apart ? of_lamps : radiance;
    const auto add = [to](const RayQueue& rays, std::size_t i) {
      to[rays.pixel[i]] += glm::vec4(rays.light[0][i], rays.light[1][i], rays.light[2][i], 0.0f);
    };
    for (std::size_t i = 0; i < queue.size; ++i)
      if (!blocked_[i]) add(queue, i);
    for (std::size_t i = 0; i < clear.size; ++i) add(clear, i);
  }
}

// Sets blocked_ for each ray to the light.
void TileTracer::find_blocked(const BounceLight& light, const RayQueue& queue, int generation) {
  if (blocked_.size() < queue.size + kQueuePad) blocked_.resize(2 * queue.size + kQueuePad);
  const float reach = light.params.kind == shared::kLightDirectional ? kInfinity : 1.0f;
  if (plan_->out.on_rays) plan_->out.on_rays({queue.columns(reach), queue.size, generation, true});
  ask_occluded(queue, reach, generation == 0 && plan_->visible.light_later ? &light : nullptr);
  block_by_ways_up(ways_up_[as_size(light.queue)], generation);
}

// Fires shadow rays at samples of the environment, and along lobes at lights.
void TileTracer::fire_at_environment(int generation) {
  fire_reflected(sky_, kInfinity, sky_ways_up_, generation);
  fire_reflected(lobe_lights_, 1.0f, {}, generation);
}

// Adds the light of shadow rays that nothing blocks to the mirrored light, also at visible points.
void TileTracer::fire_reflected(RayQueue& queue, float reach, const RayQueue& ways_up, int generation) {
  if (queue.size == 0) return;
  if (blocked_.size() < queue.size + kQueuePad) blocked_.resize(2 * queue.size + kQueuePad);
  if (plan_->out.on_rays) plan_->out.on_rays({queue.columns(reach), queue.size, generation, true});
  ask_occluded(queue, reach);
  block_by_ways_up(ways_up, generation);
  if (plan_->tints) add_light_through_glass(queue, reflected_.data());
  for (std::size_t i = 0; i < queue.size; ++i)
    if (!blocked_[i])
      reflected_[queue.pixel[i]] += glm::vec4(queue.light[0][i], queue.light[1][i], queue.light[2][i], 0.0f);
}

// Sets blocked_ for each shadow ray. later: the light that the rays go to, where they do not carry its light
// yet; null: they do.
void TileTracer::ask_occluded(const RayQueue& queue, float reach, const BounceLight* later) {
  const TilePlan& plan = *plan_;
  counts_.shadow += queue.size;
  if (!plan.passed_by_shadows.any()) {
    plan.job.tracer.occluded(queue.columns(reach), queue.size, blocked_.data());
    return;
  }
  const PassedSurfaces passed{plan.passed_by_shadows.columns(), plan.job.tracer.steps().lanes_in_holes,
                              &plan.shadows.scene};
  if (!plan.tints) {
    plan.job.tracer.occluded(queue.columns(reach), queue.size, blocked_.data(), &passed);
    return;
  }
  RayQueue& on = tinted_.begin(plan.job.tracer, passed, queue, reach, blocked_.data());
  if (later && on.size > 0) light_rays(*later, queue, on);
  tinted_.go_on(plan.job.tracer, plan.shadows, reach, blocked_.data());
}

// Sets what `rays` carry of a light. They are some of the queue's rays from visible points; `pixel` is their
// place in the queue.
void TileTracer::light_rays(BounceLight from, const RayQueue& queue, RayQueue& rays) {
  passing_points_.make_room(rays.size);
  std::size_t point = 0;  // the queue has the order of seen_
  for (std::size_t k = 0; k < rays.size; ++k) {
    const std::uint32_t pixel = queue.pixel[rays.pixel[k]];
    while (seen_.pixel[point] != pixel) ++point;
    copy_ray(seen_, point, passing_points_, k);
    passing_points_.pixel[k] = pixel;
  }
  passing_points_.size = rays.size;
  passing_.make_room(rays.size, {.medium = extra_columns().medium});
  passing_ways_up_.make_room(rays.size);
  from.queue = 0;
  from.clear_ways = nullptr;
  Bounce step = plan_->visible;
  use_queues(step);
  if (plan_->model) step.footprint = &seen_footprint_;
  step.lights = &from;
  step.light_count = 1;
  step.shadow = &passing_;
  step.ways_up = &passing_ways_up_;
  step.light_later = false;
  plan_->job.tracer.steps().bounce(step, passing_points_);
  assert(passing_.size == rays.size);
  for (int axis = 0; axis < 3; ++axis) std::copy_n(passing_.light[axis], rays.size, rays.light[axis]);
}

// A ray that would start behind something, after it was lifted, counts as blocked. Holes are ignored: the way
// up is short.
void TileTracer::block_by_ways_up(const RayQueue& up, int generation) {
  if (up.size == 0) return;
  if (up_blocked_.size() < up.size + kQueuePad) up_blocked_.resize(2 * up.size + kQueuePad);
  if (plan_->out.on_rays) plan_->out.on_rays({up.columns(1.0f), up.size, generation, true});
  plan_->job.tracer.occluded(up.columns(1.0f), up.size, up_blocked_.data());
  counts_.shadow += up.size;
  constexpr std::uint8_t kWholly = 3;
  for (std::size_t i = 0; i < up.size; ++i) blocked_[up.pixel[i]] |= up_blocked_[i] ? kWholly : 0;
}

// Adds the light of the last shadow rays that passed glass. It is traced light at visible points, too: a bit
// of the mask has no shades.
void TileTracer::add_light_through_glass(const RayQueue& queue, glm::vec4* to) {
  if (!tinted_.lit().empty()) begin_light();
  for (const TintedShadows::Lit& lit : tinted_.lit())
    if (blocked_[lit.ray] == 1) to[queue.pixel[lit.ray]] += glm::vec4(lit.light, 0.0f);
}

}  // namespace pinocchio
