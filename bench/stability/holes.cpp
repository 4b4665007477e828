// Leaves with holes, close behind each other: a ray that meets a hole continues behind it, up to 32
// times.
#include <array>
#include <cmath>
#include <utility>

#include "bench/stability/count.h"
#include "bench/stability/shapes.h"
#include "core/reference/reference.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/jitter.h"
#include "core/trace/view/view_params.h"

namespace pinocchio::stability {
namespace {

constexpr int kSamples = 4, kMostSide = 48;
// At the usual scale, and at one where a fixed offset is longer than the distance to the next leaf.
constexpr std::array kLeafSizes{1.0f, 0x1p-14f};

Scene leaves(float size) {
  MeshData mesh;
  add_leaves(mesh, glm::vec3(0.0f), size, 32);
  Scene scene(std::move(mesh));
  scene.lights.emplace_back().position = size * glm::vec3(1.5f, 1.0f, 2.0f);
  return scene;
}

// Compares each sample's triangle and shadow with the reference's, except at holes' edges, where the
// reference changes within 0.03 pixels.
FailureCount leaves_with_holes(const Method& method, int rays) {
  const int side = std::clamp(static_cast<int>(std::sqrt(static_cast<float>(rays) / 16.0f)), 16, kMostSide);
  FailureCount count;
  Workers one(1);
  for (const float size : kLeafSizes) {
    const Scene scene = leaves(size);
    const Tracer tracer = method.tracer(*scene.mesh);
    const Camera camera{"", size * glm::vec3(0.3f, 0.2f, 3.0f), glm::vec3(0.0f), {0, 1, 0}, 35.0f};
    for (int k = 0; k < kSamples; ++k) {
      View view = at_sample({camera, glm::ivec2(side)}, k);
      Image<std::uint32_t> ids;
      MaskImage mask;
      TileOutputs out;
      out.size = glm::ivec2(side);
      out.ids = &ids;
      out.mask_bits = 1;
      out.mask = &mask;
      TraceJob job{scene, tracer, one, view_params(view)};
      job.options.terminator = method.terminator;
      {
        const Timed timed(count);
        trace_tiles(job, out);
      }
      const ReferencePicture expected = reference_render(scene, view, 0, one);
      view.jitter += 0.03f;
      const ReferencePicture beside = reference_render(scene, view, 0, one);
      for (int i = 0; i < side * side; ++i) {
        const int x = i % side, y = i / side;
        const auto answer = [&](const auto& picture) {
          return std::pair(picture.ids.at(x, y), picture.mask.get(x, y));
        };
        const bool same = answer(expected) == std::pair(ids.at(x, y), mask.get(x, y));
        const bool steady = answer(expected) == answer(beside);
        ++count.trials;
        count.excused += !same && !steady ? 1 : 0;
        count.failures += !same && steady ? 1 : 0;
      }
    }
  }
  return count;
}

constexpr std::array kHoleCases{
    StressCase{"leaves with holes", "samples unlike the reference's", leaves_with_holes}};

}  // namespace

std::span<const StressCase> hole_cases() {
  return kHoleCases;
}

}  // namespace pinocchio::stability
