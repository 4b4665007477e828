#include "bench/rays/shadow_pass.h"

#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "bench/one_ray/passes.h"
#include "bench/one_ray/surface_at.h"
#include "bench/rays/sides/measure.h"
#include "core/math/median.h"
#include "core/parallel/tiles.h"
#include "core/trace/view/view_params.h"

namespace pinocchio::bench {
namespace {

constexpr int kFrames = 48, kLastFrames = 16;
constexpr float kDegreesAFrame = 1.0f;

Camera turned(Camera camera, int frame) {
  const glm::mat4 turn =
      glm::rotate(glm::mat4(1.0f), glm::radians(kDegreesAFrame * static_cast<float>(frame)), camera.up);
  camera.eye = camera.target + glm::vec3(turn * glm::vec4(camera.eye - camera.target, 0.0f));
  return camera;
}

// The shadow pass, one pixel at a time, with Embree's rays.
void embree_pass(const TraceJob& job, const EmbreeSide& embree, const Image<std::uint32_t>& ids, int bits,
                 MaskImage& mask) {
  const std::vector<shared::LightParams> lights = casting_light_params(job.scene);
  mask.resize(ids.size(), bits);
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    std::vector<std::vector<Ray>> rays(lights.size());
    std::vector<std::vector<glm::ivec2>> pixels(lights.size());
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const std::uint32_t id = ids.at(x, y);
      if (id == kNoTriangle) return;
      const Ray seen = pixel_ray(job.view, x, y);
      const SurfaceInteraction surface =
          surface_at(job.tracer.mesh(), id, seen.origin, seen.direction, job.tracer.offset());
      for (std::size_t slot = 0; slot < lights.size(); ++slot) {
        if (const std::optional<Ray> ray =
                shadow_ray(lights[slot], surface, glm::vec2(0.5f), job.options.terminator)) {
          rays[slot].push_back(*ray);
          pixels[slot].emplace_back(x, y);
        }
      }
    });
    std::vector<std::uint8_t> blocked;
    for (std::size_t slot = 0; slot < lights.size(); ++slot) {
      blocked.resize(rays[slot].size());
      embree.occluded(rays[slot], blocked);
      for (std::size_t k = 0; k < blocked.size(); ++k)
        if (!blocked[k]) mask.set_bit(pixels[slot][k].x, pixels[slot][k].y, static_cast<int>(slot));
    }
  });
}

std::size_t differing_bits(const MaskImage& a, const MaskImage& b) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < a.bytes().size(); ++i)
    differ += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(a.bytes()[i] ^ b.bytes()[i])));
  return differ;
}

ShadowPass measure(const Scene& scene, const Tracer& tracer, const EmbreeSide& embree, glm::ivec2 size,
                   Workers& workers) {
  const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  const int bits = MaskImage::bits_for(static_cast<int>(casting_lights(scene).size()));
  ShadowPass result;
  result.threads = workers.count();
  std::vector<double> ours, theirs;
  for (int frame = 0; frame < kFrames; ++frame) {
    TraceJob job{scene, tracer, workers, view_params(turned(camera, frame), size)};
    job.options.terminator = Terminator::off;  // one ray for each shadow on both sides
    Image<std::uint32_t> ids(size);
    trace_visibility(job, ids);
    MaskImage mask, embrees;
    theirs.push_back(seconds_of([&] { embree_pass(job, embree, ids, bits, embrees); }));
    RayCounts counts;
    ours.push_back(seconds_of([&] { counts = trace_shadow_mask(job, ids, bits, mask); }));
    if (frame + 1 < kFrames) continue;
    result.rays = counts.shadow;
    result.differ = differing_bits(mask, embrees);
  }
  const auto last_ms = [](const std::vector<double>& times) {
    return 1e3 * median(std::vector(times.end() - kLastFrames, times.end()));
  };
  result.first_ms = 1e3 * ours.front();
  result.ours_ms = last_ms(ours);
  result.embree_ms = last_ms(theirs);
  return result;
}

}  // namespace

std::vector<ShadowPass> measure_shadow_passes(const Scene& scene, const Tracer& tracer,
                                              const EmbreeSide& embree, glm::ivec2 size,
                                              const std::vector<Workers*>& on) {
  std::vector<ShadowPass> passes;
  if (casting_lights(scene).empty()) return passes;
  for (Workers* workers : on) passes.push_back(measure(scene, tracer, embree, size, *workers));
  return passes;
}

}  // namespace pinocchio::bench
