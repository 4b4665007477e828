// Hybrid's part of a frame asks textures only where that may change the picture: against the same with all
// textures asked.

#include "core/trace/tiles/trace_tiles.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/core/trace/rough_maps_scenes.h"
#include "tests/support/same_bits.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};

struct Traced {
  MaskImage mask;
  Image<glm::vec3> reflection{kSize};
  Image<glm::vec4> color{kSize};
};

Traced traced(TraceJob job, float light_cutoff, Image<std::uint32_t>& ids) {
  Traced result;
  TileOutputs out;
  out.size = kSize;
  out.seen = &ids;
  out.mask_bits = 8;
  out.mask = &result.mask;
  out.depth = 2;
  out.reflection = &result.reflection;
  job.options.light_cutoff = light_cutoff;
  job.options.throughput_cutoff = 0.0f;
  trace_tiles(job, out);
  shade(job, ids, result.mask, result.reflection, result.color);
  return result;
}

TEST(RoughMaps, ThePictureIsTheSameAsIfAllWereAsked) {
  Random random(5);
  for (const glm::ivec2 size : {glm::ivec2(64), {100, 70}, {257, 64}, {512, 512}, {63, 200}})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const float density : {0.1f, 0.3f, 0.7f, 4.0f}) {
        const float offset = random.between(0, 1) < 0.5f ? 0.3f : 90000.3f;
        const Scene scene = spotted_floor(size, wrap, density, offset, random);
        Workers workers(2);
        const shared::ViewParams view = view_params(scene.cameras.front(), kSize);
        for (const Isa isa : supported_isas()) {
          const Tracer tracer(scene.mesh, {}, isa);
          const TraceJob job{scene, tracer, workers, view};
          Image<std::uint32_t> ids(kSize);
          trace_visibility(job, ids);
          const Traced exact = traced(job, 0.0f, ids), quick = traced(job, 1e-30f, ids);
          ASSERT_TRUE(same_bits(exact.reflection, quick.reflection))
              << isa_name(isa) << " " << size.x << " x " << size.y << ", " << static_cast<int>(wrap) << ", "
              << density;
          ASSERT_TRUE(same_bits(exact.color, quick.color))
              << isa_name(isa) << " " << size.x << ", " << density;
        }
      }
}

}  // namespace
}  // namespace pinocchio
