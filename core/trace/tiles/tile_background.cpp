// What a tile's pixels show behind the scene: the background, and the shadows on the shadow catcher.
#include <algorithm>

#include "core/math/luminance.h"
#include "core/trace/tiles/tile_tracer.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The least coverage of what is hit, however clear it is: 0 is where nothing is.
constexpr float kLeastCoverage = 1e-30f;

// Sets ray i. `share`: of its pixel.
void put(const Ray& ray, std::uint32_t pixel, float share, std::uint32_t triangle, std::size_t i,
         RayQueue& to) {
  for (int c = 0; c < 3; ++c) {
    to.origin[c][i] = ray.origin[c];
    to.direction[c][i] = ray.direction[c];
    to.light[c][i] = share;
  }
  to.pixel[i] = pixel;
  to.triangle[i] = triangle;
}

Ray ray_of(const RayQueue& rays, std::size_t i) {
  const auto at = [i](float* const(&columns)[3]) {
    return glm::vec3(columns[0][i], columns[1][i], columns[2][i]);
  };
  return {at(rays.origin), kInfinity, at(rays.direction)};
}

}  // namespace

// Rays straight from the camera through surfaces that blend: those that hit nothing see the background.
// Those that meet the shadow catcher's plane wait for its light.
void TileTracer::see_background(RayQueue& straight) {
  if (plan_->catcher) {
    straight_ground_.make_more_room(straight.size);
    for (std::size_t i = 0; i < straight.size; ++i) {
      if (straight.triangle[i] != kNoTriangle) continue;
      const Ray ray = ray_of(straight, i);
      const std::optional<std::uint32_t> ground = plan_->catcher->triangle_at(ray);
      if (!ground) continue;
      put(ray, straight.pixel[i], straight.light[0][i], *ground, straight_ground_.size++, straight_ground_);
      for (int c = 0; c < 3; ++c) straight.light[c][i] = 0.0f;
    }
  }
  if (plan_->out.coverage) uncover(straight);
  add_background(straight);
}

// Adds the background's light along rays that hit nothing.
void TileTracer::add_background(const RayQueue& straight) {
  const Background& background = plan_->job.options.background;
  if (plan_->backdrop)
    plan_->job.tracer.steps().add_environment(*plan_->backdrop, false, straight, &reflected_[0].x);
  if (background.kind != Background::Kind::color) return;
  for (std::size_t i = 0; i < straight.size; ++i)
    if (straight.triangle[i] == kNoTriangle)
      for (int c = 0; c < 3; ++c)
        reflected_[straight.pixel[i]][c] += straight.light[c][i] * background.color[c];
}

// Rays that went through all that blends and hit nothing: what is left of their light is not covered.
void TileTracer::uncover(const RayQueue& rays) {
  for (std::size_t i = 0; i < rays.size; ++i)
    if (rays.triangle[i] == kNoTriangle)
      uncover(rays.pixel[i], (rays.light[0][i] + rays.light[1][i] + rays.light[2][i]) / 3.0f);
}

void TileTracer::uncover(std::uint32_t pixel, float by) {
  float& alpha = direct_[pixel].a;
  alpha = std::max(alpha - by, kLeastCoverage);
}

// Adds the background where nothing is hit; alpha stays 0.
void TileTracer::paint_background() {
  const Background& background = plan_->job.options.background;
  if (plan_->backdrop) paint_backdrop();
  if (background.kind != Background::Kind::color) return;
  for (glm::vec4& pixel : direct_)
    if (pixel.a == 0.0f) pixel = glm::vec4(background.color, 0.0f);
}

void TileTracer::paint_backdrop() {
  const LaneSteps& steps = plan_->job.tracer.steps();
  if (!plan_->model) {
    steps.paint_background(*plan_->backdrop, plan_->view, tile_, direct_.data());
    return;
  }
  sky_.make_room(kPixels);
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y)
    for (int x = tile_.lo.x; x < tile_.hi.x; ++x) {
      const auto pixel = as_uint32((y - tile_.lo.y) << kTileBits | (x - tile_.lo.x));
      if (direct_[pixel].a != 0.0f) continue;
      const glm::vec3 direction = plan_->model->ray(x, y).direction;
      if (direction == glm::vec3(0.0f)) continue;
      put({glm::vec3(0.0f), kInfinity, direction}, pixel, 1.0f, kNoTriangle, sky_.size++, sky_);
    }
  for (std::size_t i = 0; i < sky_.size; ++i) direct_[sky_.pixel[i]] = glm::vec4(0.0f);
  steps.add_environment(*plan_->backdrop, false, sky_, &direct_[0].x);
}

// Finds the share of light that shadows take from the shadow catcher: at the pixels that see nothing, and
// behind surfaces that blend, where the background is added now.
void TileTracer::catch_shadows() {
  std::array<bool, kPixels> covered{};
  for (std::size_t i = 0; i < seen_.size; ++i) covered[seen_.pixel[i]] = true;
  RayQueue& rays = ground_;
  rays.make_room(kPixels);
  for (int y = 0; y < tile_.size().y; ++y)
    for (int x = 0; x < tile_.size().x; ++x)
      if (const auto pixel = as_uint32(y << kTileBits | x); !covered[pixel]) rays.pixel[rays.size++] = pixel;
  if (plan_->model)
    plan_->model->fill(tile_.lo, kTileBits, rays);
  else
    plan_->job.tracer.steps().camera_rays(plan_->view, tile_.lo, rays);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Ray ray = ray_of(rays, i);
    if (const std::optional<std::uint32_t> ground = plan_->catcher->triangle_at(ray))
      put(ray, rays.pixel[i], 1.0f, *ground, kept++, rays);
  }
  rays.size = kept;
  find_lost(rays);
  find_lost(straight_ground_);
  for (std::size_t i = 0; i < straight_ground_.size; ++i) {
    const std::uint32_t pixel = straight_ground_.pixel[i];
    const float left = 1.0f - ground_light_[pixel].a;
    for (int c = 0; c < 3; ++c) straight_ground_.light[c][i] *= left;
    straight_ground_.triangle[i] = kNoTriangle;
  }
  if (plan_->out.coverage) uncover(straight_ground_);
  add_background(straight_ground_);
}

// Lights the plane where the rays meet it, as a white matt surface, with and without shadows. Writes the lost
// share to A of the pixels' ground_light_.
void TileTracer::find_lost(RayQueue& rays) {
  if (rays.size == 0) return;
  for (std::size_t i = 0; i < rays.size; ++i) ground_light_[rays.pixel[i]] = glm::vec4(0.0f);
  TraceOptions options = plan_->job.options;
  options.sky_bounce = 0.0f;
  options.light_cutoff = options.throughput_cutoff = 0.0f;  // shares of light, however faint it is
  const Footprint no_textures;
  Bounce step = plan_->further;
  step.scene = plan_->catcher->arrays();
  step.options = &options;
  step.footprint = &no_textures;
  step.visible = true;
  step.attenuates = step.lobes = false;
  step.one_candidate = true;
  step.environment = plan_->ground_sky && plan_->ground_sky->shines ? &*plan_->ground_sky : nullptr;
  make_room(rays.size, next_);
  sky_.make_room(rays.size * (2 + as_size(options.sky_occlusion)));
  use_queues(step);
  step.radiance = step.traced = &ground_light_[0].x;
  for (const LightGroup& group : plan_->further_lights) {
    const bool is_first = &group == &plan_->further_lights.front();
    if (!is_first) make_room_for_shadows(rays.size);
    plan_->job.tracer.steps().bounce(is_first ? step : lights_alone(group, step), rays);
    for (const BounceLight& light : group.lights)
      if (light.slot >= 0)
        count_lost(shadow_[as_size(light.queue)],
                   light.params.kind == shared::kLightDirectional ? kInfinity : 1.0f);
    if (is_first) count_lost(sky_, kInfinity);
  }
  for (std::size_t i = 0; i < rays.size; ++i) {
    glm::vec4& light = ground_light_[rays.pixel[i]];
    const float all = luminance(glm::vec3(light));
    light.a = all > 0.0f ? std::clamp(light.a / all, 0.0f, 1.0f) : 0.0f;
  }
}

// Adds the light that shadow rays carry, and that of the blocked ones to what is lost.
void TileTracer::count_lost(const RayQueue& queue, float reach) {
  if (queue.size == 0) return;
  if (blocked_.size() < queue.size + kQueuePad) blocked_.resize(2 * queue.size + kQueuePad);
  if (plan_->out.on_rays) plan_->out.on_rays({queue.columns(reach), queue.size, 0, true});
  ask_occluded(queue, reach);
  for (std::size_t i = 0; i < queue.size; ++i) {
    const glm::vec3 carried(queue.light[0][i], queue.light[1][i], queue.light[2][i]);
    const float lost = blocked_[i] ? luminance(carried) : 0.0f;
    ground_light_[queue.pixel[i]] += glm::vec4(carried, lost);
  }
  if (!plan_->tints) return;
  for (const TintedShadows::Lit& lit : tinted_.lit())  // came through glass, and is not lost
    if (blocked_[lit.ray]) ground_light_[queue.pixel[lit.ray]].a -= luminance(lit.light);
}

// Darkens the background where the plane lost light.
void TileTracer::darken_by_lost() {
  for (std::size_t i = 0; i < ground_.size; ++i) {
    const std::uint32_t pixel = ground_.pixel[i];
    const float lost = ground_light_[pixel].a;
    direct_[pixel] = glm::vec4((1.0f - lost) * glm::vec3(direct_[pixel]), lost);
  }
}

// Writes the lost share in place of mirrored light.
void TileTracer::write_lost() {
  for (std::size_t i = 0; i < ground_.size; ++i) {
    const std::uint32_t pixel = ground_.pixel[i], row = pixel >> kTileBits;
    const glm::ivec2 at = tile_.lo + glm::ivec2(pixel - (row << kTileBits), row);
    plan_->out.reflection->at(at.x, at.y) = glm::vec3(ground_light_[pixel].a);
  }
}

}  // namespace pinocchio
