#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/surface.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

constexpr std::uint32_t kNoCell = 0xffffffffu;

// The shadow rays of one tile towards one light, and the pixel and cell each answers for.
struct LightRays {
  std::vector<Ray> rays;
  std::vector<glm::ivec2> pixels;
  std::vector<std::uint32_t> cells;
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
  TileShadows(const TraceJob& job, const Slots& lights, MaskImage& mask) : job_(job), lights_(lights), mask_(mask) {}

  void add(std::uint32_t id, glm::ivec2 pixel) {
    const Ray ray = pixel_ray(job_.view, pixel.x, pixel.y);
    const std::uint32_t cell = job_.cells ? cell_of(id, ray) : kNoCell;
    unsigned open = (1u << lights_.size()) - 1u;  // slots of which nothing is known
    if (cell != kNoCell) open = take_known(cell, pixel);
    if (open == 0) return;
    const Surface surface = surface_at(job_.scene, id, ray.origin, ray.direction, job_.tracer.offset());
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      if (!(open >> slot & 1u)) continue;
      const bool dim = job_.least_light > 0.0f && most_light(lights_[slot], surface) < job_.least_light;
      if (const std::optional<Ray> to_light = dim ? std::nullopt : shadow_ray(lights_[slot], surface)) {
        by_light_[slot].rays.push_back(*to_light);
        by_light_[slot].pixels.push_back(pixel);
        by_light_[slot].cells.push_back(cell);
      } else if (cell != kNoCell) {
        findings_.push_back({cell, static_cast<std::uint8_t>(slot), false});
      }
    }
  }

  // Rays fired.
  std::uint64_t finish() {
    std::uint64_t fired = 0;
    std::vector<std::uint8_t> blocked;
    for (std::size_t slot = 0; slot < lights_.size(); ++slot) {
      const LightRays& work = by_light_[slot];
      blocked.resize(work.rays.size());
      job_.tracer.occluded(work.rays, blocked);
      for (std::size_t k = 0; k < blocked.size(); ++k) {
        if (!blocked[k]) mask_.set_bit(work.pixels[k].x, work.pixels[k].y, static_cast<int>(slot));
        if (work.cells[k] != kNoCell)
          findings_.push_back({work.cells[k], static_cast<std::uint8_t>(slot), blocked[k] != 0});
      }
      fired += work.rays.size();
    }
    if (job_.cells) job_.cells->note(findings_);
    return fired;
  }

 private:
  std::uint32_t cell_of(std::uint32_t id, const Ray& ray) {
    if (id != triangle_) {  // neighbours often see the same
      triangle_ = id;
      side_ = job_.cells->side_of(id, ray.origin);
    }
    if (side_.cuts == 0) return kNoCell;
    const glm::uvec3& corners = job_.scene.triangles[id];
    const std::vector<glm::vec3>& p = job_.scene.positions;
    return LitCells::cell_of(side_, shared::barycentric_of(ray.origin, ray.direction, p[corners.x],
                                                           p[corners.y], p[corners.z]))
        .value_or(kNoCell);
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
  Slots lights;
  for (const int i : casting_lights(job.scene))
    lights.push_back(light_params(job.scene.lights[static_cast<std::size_t>(i)]));
  assert(static_cast<int>(lights.size()) <= bits);
  mask.resize(ids.size(), bits);
  if (lights.empty()) return {};

  if (job.cells) job.cells->begin_pass(lights, job.least_light, job.workers);
  std::atomic<std::uint64_t> fired{0};
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    TileShadows tile(job, lights, mask);
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      if (const std::uint32_t id = ids.at(x, y); id != kNoTriangle) tile.add(id, {x, y});
    });
    fired += tile.finish();
  });
  return {.shadow = fired};
}

}  // namespace pinocchio
