#include "core/trace/tiles/tile_tracer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/base/clock.h"
#include "core/shade/surface.h"
#include "core/simd/four.h"
#include "core/trace/settled/tile_rays.h"
#include "core/trace/view/tile_frustum.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Pictures of this size are written past the caches: what they hold is needed for the next tiles.
constexpr std::size_t kStreamedBytes = std::size_t{4} << 20;

// Seconds since the last call.
class Lap {
 public:
  double restart() {
    const double now = now_s(), since = now - last_;
    last_ = now;
    return since;
  }

 private:
  double last_ = now_s();
};

// The pixels of a tile along a Z curve: packets of any width are neighbours in the picture.
const std::vector<std::uint32_t>& z_curve() {
  static const std::vector<std::uint32_t> kCurve = [] {
    std::vector<std::uint32_t> curve;
    TileGrid::for_each_pixel({{0, 0}, glm::ivec2(TileGrid::kTileSize)},
                             [&](int x, int y) { curve.push_back(as_uint32(y << kTileBits | x)); });
    return curve;
  }();
  return kCurve;
}

}  // namespace

TileResult TileTracer::trace(const TilePlan& plan, const PixelBox& tile, const KnownOfTile& known) {
  plan_ = &plan;
  tile_ = tile;
  known_ = known;
  if (rays_miss_scene()) known_.sees_nothing = true;
  counts_ = {};
  reflects_ = false;
  if (plan.out.sampled) begin_light();
  TileTimes times;
  Lap lap;
  if (!known_.sees_nothing) mask_.assign(as_size(plan.visible_lights.back().byte + 1) * kPixels, 0);
  sees_something_ = !known_.sees_nothing;
  if (plan.out.seen && sees_something_) {
    fetch_ids();
    times.primary = lap.restart();
    find_settled();
    times.shadow = lap.restart();
  }
  start();
  find_visible();
  times.primary += lap.restart();
  if (!plan.out.seen) {
    sees_something_ = seen_.size > 0;
    drop_settled();
  }
  if (seen_.size > 0) {
    light_visible();
    times.shadow += lap.restart();
    follow();
    times.reflection = lap.restart();
  }
  if (plan_->catcher) {
    catch_shadows();
    times.shadow += lap.restart();
  }
  write();
  times.composite = lap.restart();
  return {counts_, times};
}

// As write() does where no triangle is seen: ids are given, and masks and `added` have nothing there.
bool TileTracer::has_nothing_to_do(const TilePlan& plan, const KnownOfTile& known) {
  const TileOutputs& out = plan.out;
  const bool draws = plan.catcher || plan.beyond || out.sampled || out.color;
  return known.sees_nothing && !draws && (!out.reflection || known.is_black());
}

// True if no camera ray of the tile can meet the scene. False where on_rays wants all rays.
bool TileTracer::rays_miss_scene() const {
  return !plan_->out.seen && !plan_->out.on_rays && !plan_->model &&
         misses(TileFrustum(plan_->view, tile_), plan_->job.tracer.trees());
}

// Nothing is mirrored yet, and nothing seen by the filter.
void TileTracer::begin_light() {
  if (reflects_) return;
  reflects_ = true;
  const std::size_t layers = plan_->sampled_layers();
  std::fill_n(reflected_.begin(), (1 + layers) * kPixels, glm::vec4(0.0f));
  std::fill_n(reflected_.begin() + kSampledPixels + kLampPixels, layers * kPixels, glm::vec4(0.0f));
  points_.assign(layers * kPixels, {});
}

// Makes the rays of the tile's pixels; with given ids, of the pixels that see something.
void TileTracer::start() {
  seen_.make_room(kPixels);
  ground_.make_room(0);
  straight_ground_.make_room(0);
  const bool given = plan_->out.seen != nullptr, whole = tile_.size() == glm::ivec2(TileGrid::kTileSize);
  if (known_.sees_nothing) return;
  if (whole && !given) {
    std::copy(z_curve().begin(), z_curve().end(), seen_.pixel);
    seen_.size = kPixels;
  } else {
    if (!given) {
      ids_.fill(kNoTriangle);
      for (int y = 0; y < tile_.size().y; ++y)
        std::fill_n(&ids_[as_size(y) << kTileBits], tile_.size().x, 0u);
    }
    list_pixels();
  }
  if (!plan_->model) return plan_->job.tracer.steps().camera_rays(plan_->view, tile_.lo, seen_);
  plan_->model->fill(tile_.lo, kTileBits, seen_);
  seen_footprint_ = plan_->seen_footprint;
  if (seen_footprint_.angle > 0.0f)
    seen_footprint_ =
        plan_->model->footprint((tile_.lo + tile_.hi) / 2, plan_->job.options.texture_footprint);
}

// The pixels that have an id, along the curve.
void TileTracer::list_pixels() {
  constexpr std::size_t kSquare = 4;  // pixels along the sides of squares that are left out as a whole
  const std::span curve(z_curve());
  std::size_t count = 0;
  for (std::size_t i = 0; i < kPixels; i += kSquare * kSquare) {
    const std::span square = curve.subspan(i, kSquare * kSquare);
    const auto row = [&](std::size_t y) {
      return *reinterpret_cast<const FourInts*>(&ids_[square[0] + (y << kTileBits)]);
    };
    if (!any(~(row(0) & row(1) & row(2) & row(3)))) continue;
    for (const std::uint32_t pixel : square) {
      const std::uint32_t triangle = ids_[pixel];
      seen_.pixel[count] = pixel;
      seen_.triangle[count] = triangle;
      count += triangle != kNoTriangle ? 1 : 0;
    }
  }
  seen_.size = count;
}

// Copies the tile's given ids.
void TileTracer::fetch_ids() {
  const Image<std::uint32_t>& seen = *plan_->out.seen;
  const auto scale = as_size(plan_->out.scale), width = as_size(tile_.size().x);
  if (tile_.size() != glm::ivec2(TileGrid::kTileSize)) ids_.fill(kNoTriangle);
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y) {
    const std::uint32_t* const from = &seen.at(tile_.lo.x * plan_->out.scale, y * plan_->out.scale);
    std::uint32_t* const to = &ids_[row_of(y)];
    if (scale == 1)
      std::memcpy(to, from, width * sizeof(*to));
    else
      for (std::size_t i = 0; i < width; ++i) to[i] = from[i * scale];
  }
}

// of_camera: the rays come straight from the camera.
void TileTracer::find_hits(RayQueue& rays, int generation, bool of_camera) {
  if (plan_->out.on_rays) plan_->out.on_rays({rays.columns(), rays.size, generation, false});
  const MaterialMarks passed = plan_->passed_backs.columns();
  const MaterialMarks* const backs = of_camera && plan_->passed_backs.any() ? &passed : nullptr;
  plan_->job.tracer.closest_hits(rays.columns(), rays.size, rays.triangle, nullptr, backs);
  if (plan_->has_holes) holes_.pass(plan_->job.tracer, plan_->shadows, rays, backs);
}

void TileTracer::find_visible() {
  const TileOutputs& out = plan_->out;
  if (out.seen) return;
  counts_.primary += as_size(tile_.size().x) * as_size(tile_.size().y);
  if (!known_.sees_nothing) find_hits(seen_, 0, true);
  if (out.ids) {
    if (known_.sees_nothing) ids_.fill(kNoTriangle);
    for (std::size_t i = 0; i < seen_.size; ++i) ids_[seen_.pixel[i]] = seen_.triangle[i];
    for (int y = tile_.lo.y; y < tile_.hi.y; ++y)
      std::memcpy(&out.ids->at(tile_.lo.x, y), &ids_[row_of(y)],
                  as_size(tile_.size().x) * sizeof(std::uint32_t));
  }
  plan_->job.tracer.steps().keep_hits(seen_);
}

// Sets the mask at the visible points of which all is known, and takes their ids out of ids_.
void TileTracer::find_settled() {
  if (!plan_->settled) return;
  const TileRays rays(plan_->view, tile_.lo, plan_->seen_footprint);
  counts_.shadow += plan_->job.tracer.steps().find_settled(*plan_->settled, plan_->visible.scene, rays,
                                                           ids_.data(), mask_.data());
}

// As find_settled(), but rays have found the ids: drops the rays that meet settled points.
void TileTracer::drop_settled() {
  if (!plan_->settled || seen_.size == 0) return;
  ids_.fill(kNoTriangle);
  for (std::size_t i = 0; i < seen_.size; ++i) ids_[seen_.pixel[i]] = seen_.triangle[i];
  find_settled();
  for (std::size_t i = 0; i < seen_.size; ++i) seen_.triangle[i] = ids_[seen_.pixel[i]];
  plan_->job.tracer.steps().keep_hits(seen_);
}

ExtraColumns TileTracer::extra_columns() const {
  return {.width = plan_->further.footprint->angle > 0.0f, .medium = plan_->further.attenuates};
}

void TileTracer::make_room(std::size_t rays, Generation& next) {
  const ExtraColumns extra = extra_columns();
  ExtraColumns of_mirrored = extra;
  of_mirrored.way = plan_->beyond != nullptr;
  ExtraColumns of_straight = of_mirrored;
  of_straight.density =
      plan_->tints && plan_->environment && (plan_->further.lobes || plan_->out.indirect > 0);
  of_mirrored.density = plan_->further.lobes || of_straight.density;
  next[kMirrored].make_room(rays, of_mirrored);
  next[kRefracted].make_room(rays, of_straight);
  next[kStraight].make_room(plan_->blends ? rays : 0, of_straight);
  next[kStraightFromCamera].make_room(plan_->straight_apart ? rays : 0, of_straight);
  if (plan_->out.indirect > 0) next_diffuse_.make_more_room(rays, extra);
  make_room_for_shadows(rays);
}

// For the lights of one group.
void TileTracer::make_room_for_shadows(std::size_t rays) {
  const ExtraColumns of_shadow{.medium = plan_->tints && extra_columns().medium};
  for (std::size_t i = 0; i < plan_->most_casting; ++i) {
    shadow_[i].make_room(rays, of_shadow);
    clear_[i].make_room(plan_->clear_ways.empty() ? 0 : rays);
  }
  // A sample of the environment, one along a lobe, and distant lights that the lobe meets.
  const std::size_t along_lobes = plan_->further.lobes ? plan_->most_sized : 0;
  const std::size_t hiding = plan_->further.prefiltered ? as_size(plan_->job.options.sky_occlusion) : 0;
  sky_.make_room(rays * (plan_->further.lobes ? 2 + along_lobes + hiding : 1 + hiding), of_shadow);
  lobe_lights_.make_room(rays * along_lobes, of_shadow);
  const std::size_t up = plan_->job.options.terminator == Terminator::turned_away ? rays : 0;
  for (std::size_t i = 0; i < plan_->most_casting; ++i) ways_up_[i].make_room(up);
  sky_ways_up_.make_room(plan_->further.environment ? up : 0);
}

void TileTracer::use_queues(Bounce& step) {
  step.corner = glm::uvec2(plan_->first + tile_.lo * plan_->out.scale);
  step.shadow = shadow_.data();
  step.clear = clear_.data();
  step.ways_up = ways_up_.data();
  step.sky = &sky_;
  step.sky_ways_up = &sky_ways_up_;
  step.lobe_lights = &lobe_lights_;
}

void TileTracer::bounce(Bounce step, int generation, const RayQueue& rays, Generation& next,
                        glm::vec4* radiance, bool of_camera) {
  use_queues(step);
  step.dimension = as_uint32(generation) * shared::kDimensionsOfBounce;
  step.radiance = &radiance->x;
  step.traced = &reflected_[0].x;
  if (step.mirrored) {
    step.mirrored = &next[kMirrored];
    step.refracted = &next[kRefracted];
  }
  if (step.straight)
    step.straight = &next[of_camera && plan_->straight_apart ? kStraightFromCamera : kStraight];
  plan_->job.tracer.steps().bounce(step, rays);
}

void TileTracer::light_visible() {
  if (plan_->visible.adds_light) {
    direct_.fill(glm::vec4(0.0f));
    for (std::size_t i = 0; i < seen_.size; ++i) direct_[seen_.pixel[i]].a = 1.0f;
  }
  next_diffuse_.make_room(0, extra_columns());
  make_room(seen_.size, rays_);
  Bounce step = plan_->visible;
  if (plan_->model) step.footprint = &seen_footprint_;
  step.mirrored = step.straight = plan_->out.depth > 0 ? rays_.data() : nullptr;
  step.diffuse = plan_->out.indirect > 0 ? &next_diffuse_ : nullptr;
  if (!step.mirrored && !step.diffuse && step.light_count == 0 && plan_->visible_lights.size() == 1 &&
      !step.adds_ambient && !step.environment && !step.prefiltered)
    return;
  if (plan_->out.sampled) {
    step.sampled = kSampledPixels;
    step.points = points_.data();
  } else if (step.environment || step.prefiltered || step.lobes || step.tints_at_once() ||
             plan_->lights_in_reflection) {
    begin_light();
  }
  bounce(step, 0, seen_, rays_, direct_.data(), true);
  light_points(step, 0, {&seen_, 1}, plan_->visible_lights, direct_.data());
}

// Black light is not written again where it is known to be there.
void TileTracer::write_reflection() {
  Image<glm::vec3>& to = *plan_->out.reflection;
  const bool was_black = known_.is_black();
  if (known_.black) *known_.black = reflects_ ? 0 : 1;
  if (was_black && !reflects_) return;
  const auto width = as_size(tile_.size().x);
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y) {
    glm::vec3* const pixels = &to.at(tile_.lo.x, y);
    const glm::vec4* const reflected = &reflected_[row_of(y)];
    if (reflects_)
      for (std::size_t i = 0; i < width; ++i) pixels[i] = glm::vec3(reflected[i]);
    else
      std::memset(pixels, 0, width * sizeof(glm::vec3));
  }
}

void TileTracer::write_sampled(Image<SampledPoint>& to, std::size_t first) const {
  const auto width = as_size(tile_.size().x);
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y) {
    const std::size_t row = first + row_of(y);
    for (std::size_t i = row; i < row + width; ++i) {
      SampledPoint& point = (&to.at(tile_.lo.x, y))[i - row] = points_[i];
      point.light = glm::vec3(reflected_[kSampledPixels + i]);
      point.lamp_light = glm::vec3(reflected_[kSampledPixels + kLampPixels + i]);
    }
  }
}

void TileTracer::write_mask(MaskImage& to) const {
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y)
    for (std::size_t i = 0; i < mask_.size(); i += kPixels)
      to.set_row(tile_.lo.x, y, std::span(mask_).subspan(i + row_of(y), as_size(tile_.size().x)),
                 as_int(i / kPixels));
}

// Puts the light of all pixels together, in direct_.
void TileTracer::composite() {
  if (seen_.size == 0) return direct_.fill(glm::vec4(0.0f));
  if (!reflects_) return;
  for (std::size_t i = 0; i < kPixels; ++i) direct_[i] += reflected_[i];
}

// The light in direct_, or black.
void TileTracer::write_color(Image<glm::vec4>& to, bool black) const {
  alignas(16) static const std::array<glm::vec4, TileGrid::kTileSize> kBlack{};
  const bool large = to.pixels().size_bytes() >= kStreamedBytes;
  for (int y = tile_.lo.y; y < tile_.hi.y; ++y) {
    glm::vec4* const pixels = &to.at(tile_.lo.x, y);
    const glm::vec4* const light = black ? kBlack.data() : &direct_[row_of(y)];
    const auto width = as_size(tile_.size().x);
    if (large)
      for (std::size_t i = 0; i < width; ++i) stream_four(&pixels[i].x, load_four(&light[i].x));
    else
      std::memcpy(pixels, light, width * sizeof(glm::vec4));
  }
  if (large) finish_streams();
}

void TileTracer::write() {
  const TileOutputs& out = plan_->out;
  if (out.reflection) write_reflection();
  if (out.reflection && out.caught_in_reflection) write_lost();
  if (out.sampled) write_sampled(*out.sampled, 0);
  if (plan_->beyond) write_sampled(*plan_->beyond, kPixels);
  if (out.mask && sees_something_) write_mask(*out.mask);
  if (!out.color && !out.added) return;
  const bool has_background =
      plan_->backdrop || plan_->job.options.background.kind == Background::Kind::color;
  const bool black = seen_.size == 0 && !has_background && !plan_->catcher;
  if (!black) composite();
  if (out.added && seen_.size > 0)
    for (int y = tile_.lo.y; y < tile_.hi.y; ++y)
      for (int x = tile_.lo.x; x < tile_.hi.x; ++x)
        out.added->at(x, y) += glm::vec3(direct_[row_of(y) + as_size(x - tile_.lo.x)]);
  if (!out.color) return;
  if (has_background) paint_background();
  if (plan_->catcher) darken_by_lost();
  write_color(*out.color, black);
}

}  // namespace pinocchio
