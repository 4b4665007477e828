#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/surface.h"
#include "core/trace/view_params.h"

namespace pinocchio {
namespace {

constexpr int kBlock = 8;  // pixels a side that are looked up together

// The shadow rays of one tile towards one light, and the pixel and cell each answers for.
struct LightRays {
  std::vector<Ray> rays;
  std::vector<glm::ivec2> pixels;
  std::vector<std::optional<std::uint32_t>> cells;
};

using Slots = std::vector<shared::LightParams>;

// No less than what the light brings the point, in its brightest colour: Phong's terms with cosine and
// highlight at their greatest.
float most_light(const shared::LightParams& light, const Surface& surface) {
  const shared::Incident incident = shared::incident_light(light, surface.p_world);
  const float n_dot_l = std::max(glm::dot(surface.n_shading, incident.to_light), 0.0f);
  const glm::vec3 most = incident.radiance * (surface.phong.diffuse * n_dot_l + surface.phong.specular);
  return std::max({most.r, most.g, most.b});
}

// One tile of the pass.
class TileShadows {
 public:
  TileShadows(const TraceJob& job, const Slots& lights, MaskImage& mask)
      : job_(job), lights_(lights), mask_(mask) {}

  void add(const Image<std::uint32_t>& ids, const PixelBox& block) {
    if (job_.cells && all_known(ids, block)) return;
    TileGrid::for_each_pixel(block, [&](int x, int y) {
      if (const std::uint32_t id = ids.at(x, y); id != kNoTriangle) add(id, {x, y});
    });
  }

  // Fires the rays that are needed; returns how many.
  std::uint64_t finish() {
    std::uint64_t fired = 0;
    std::vector<std::uint8_t> blocked;
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      const LightRays& work = by_light_[slot];
      blocked.resize(work.rays.size());
      job_.tracer.occluded(work.rays, blocked);
      for (std::size_t k = 0; k < blocked.size(); ++k) {
        if (!blocked[k]) mask_.set_bit(work.pixels[k].x, work.pixels[k].y, static_cast<int>(slot));
        if (work.cells[k])
          findings_.push_back({*work.cells[k], static_cast<std::uint8_t>(slot), blocked[k] != 0});
      }
      fired += work.rays.size();
    }
    if (job_.cells) job_.cells->note(findings_);
    return fired;
  }

 private:
  void add(std::uint32_t id, glm::ivec2 pixel) {
    const Ray ray = pixel_ray(job_.view, pixel.x, pixel.y);
    const std::optional<std::uint32_t> cell = job_.cells ? cell_of(id, ray) : std::nullopt;
    unsigned open = (1u << lights_.size()) - 1u;  // slots of which nothing is known
    if (cell) open = take_known(*cell, pixel);
    if (open == 0) return;
    const auto surface_of = job_.least_light > 0.0f ? surface_at : bare_surface_at;
    const Surface surface =
        surface_of(job_.tracer.mesh(), id, ray.origin, ray.direction, job_.tracer.offset());
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      if (!(open >> slot & 1u)) continue;
      const bool dim = job_.least_light > 0.0f && most_light(lights_[slot], surface) < job_.least_light;
      if (const std::optional<Ray> to_light = dim ? std::nullopt : shadow_ray(lights_[slot], surface)) {
        by_light_[slot].rays.push_back(*to_light);
        by_light_[slot].pixels.push_back(pixel);
        by_light_[slot].cells.push_back(cell);
      } else if (cell) {
        findings_.push_back({*cell, static_cast<std::uint8_t>(slot), false});
      }
    }
  }

  // Whether one triangle fills the block and all of its lights are known: then their mask bits are set.
  bool all_known(const Image<std::uint32_t>& ids, const PixelBox& block) {
    if (block.size() != glm::ivec2(kBlock)) return false;
    const std::uint32_t id = ids.at(block.lo.x, block.lo.y);
    if (id == kNoTriangle) return false;
    bool same = true;
    for (int y = block.lo.y; y < block.hi.y; ++y)
      for (int x = block.lo.x; x < block.hi.x; ++x) same &= ids.at(x, y) == id;
    if (!same) return false;
    std::array<glm::vec3, 4> weights;
    for (int i = 0; i < 4; ++i) {
      const Ray ray =
          pixel_ray(job_.view, i % 2 == 0 ? block.lo.x : block.hi.x - 1, i < 2 ? block.lo.y : block.hi.y - 1);
      look_at(id, ray.origin);
      weights[static_cast<std::size_t>(i)] = weights_at(job_.tracer.mesh(), id, ray.origin, ray.direction);
    }
    std::array<LitCells::Known, kMaxCastingLights> known;
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      known[slot] = job_.cells->known_between(side_, weights, slot);
      if (known[slot] == LitCells::Known::nothing) return false;
    }
    for (std::size_t slot = 0; slot < lights_.size(); ++slot)
      if (known[slot] == LitCells::Known::lit)
        mask_.set_block(block.lo.x, block.lo.y, static_cast<int>(slot));
    return true;
  }

  void look_at(std::uint32_t id, const glm::vec3& eye) {
    if (id == triangle_) return;  // neighbours often see the same
    triangle_ = id;
    side_ = job_.cells->side_of(id, eye);
  }

  std::optional<std::uint32_t> cell_of(std::uint32_t id, const Ray& ray) {
    look_at(id, ray.origin);
    if (side_.cuts == 0) return std::nullopt;
    return LitCells::cell_of(side_, weights_at(job_.tracer.mesh(), id, ray.origin, ray.direction));
  }

  // Sets the mask bits that are known; the slots that are not.
  unsigned take_known(std::uint32_t cell, glm::ivec2 pixel) {
    unsigned open = 0;
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      const LitCells::Known known = job_.cells->known(cell, slot);
      if (known == LitCells::Known::nothing) open |= 1u << slot;
      if (known == LitCells::Known::lit) mask_.set_bit(pixel.x, pixel.y, static_cast<int>(slot));
    }
    return open;
  }

  const TraceJob& job_;
  const Slots& lights_;
  MaskImage& mask_;
  std::array<LightRays, kMaxCastingLights> by_light_;
  std::vector<LitCells::Finding> findings_;
  std::uint32_t triangle_ = kNoTriangle;
  LitCells::Side side_;
};

}  // namespace

RayCounts trace_shadow_mask(const TraceJob& job, const Image<std::uint32_t>& ids, int bits, MaskImage& mask) {
  const Slots lights = casting_light_params(job.scene);
  assert(static_cast<int>(lights.size()) <= bits);
  mask.resize(ids.size(), bits);
  if (lights.empty()) return {};

  std::unique_lock<std::mutex> pass;
  if (job.cells) pass = job.cells->begin_pass(lights, job.least_light, job.workers);
  std::atomic<std::uint64_t> fired{0};
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    TileShadows tile(job, lights, mask);
    const PixelBox box = grid.tile(i);
    for (int y = box.lo.y; y < box.hi.y; y += kBlock)
      for (int x = box.lo.x; x < box.hi.x; x += kBlock)
        tile.add(ids, {{x, y}, glm::min(glm::ivec2(x, y) + kBlock, box.hi)});
    fired += tile.finish();
  });
  return {.shadow = fired};
}

}  // namespace pinocchio
