// The reference beside others on the project's own scenes: Embree's primary hits, the tracer's pictures.
#include <cmath>
#include <memory>

#include "bench/one_ray/passes.h"
#include "core/reference/reference.h"
#include "core/reference/reference_tree.h"
#include "core/trace/view/view_params.h"
#include "tests/support/embree.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

Camera first_camera_of(const Scene& scene) {
  return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
}

// Two hits are one where they name the same triangle, or meet where two triangles do.
bool same(const ReferenceHit& ours, const Hit& theirs) {
  if (ours.triangle == theirs.triangle) return true;
  const double t = static_cast<double>(theirs.t);
  return ours.valid() && theirs.valid() && std::abs(ours.t - t) <= 1e-5 * t;
}

// Whether a ray a hundredth of a pixel beside it sees something else, by the reference alone.
bool at_silhouette(const ReferenceTree& tree, const shared::ViewParams& view, const ReferenceRay& ray,
                   const ReferenceHit& hit) {
  for (const double dx : {-0.01, 0.0, 0.01})
    for (const double dy : {-0.01, 0.0, 0.01}) {
      const glm::dvec3 direction =
          ray.direction + dx * glm::dvec3(view.step_x) + dy * glm::dvec3(view.step_y);
      const ReferenceHit beside = tree.closest_hit({ray.origin, direction});
      if (beside.valid() != hit.valid() || std::abs(beside.t - hit.t) > 1e-3 * hit.t) return true;
    }
  return false;
}

class ReferenceAgreement : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceAgreement, testing::ValuesIn(own_scenes()),
                         [](const auto& scene) { return "scene" + std::to_string(scene.index); });

TEST_P(ReferenceAgreement, EmbreeHitsTheSame) {
  constexpr glm::ivec2 kSize{200, 150};
  const Scene scene = load_or_die(source_path(GetParam()));
  const ReferenceTree tree(*scene.mesh);
  const Embree embree(*scene.mesh);
  const shared::ViewParams view = view_params(first_camera_of(scene), kSize);
  int different = 0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const Ray ray = pixel_ray(view, x, y);
      const ReferenceRay same_ray{glm::dvec3(ray.origin), glm::dvec3(ray.direction)};
      const ReferenceHit hit = tree.closest_hit(same_ray);
      if (same(hit, embree.closest_hit(ray))) continue;
      ++different;
      EXPECT_TRUE(at_silhouette(tree, view, same_ray, hit)) << "pixel " << x << ", " << y;
    }
  std::printf("  %s: %d of %d primary hits differ\n", GetParam().c_str(), different, kSize.x * kSize.y);
}

struct Drawn {
  Image<std::uint32_t> ids;
  MaskImage mask;
  Image<glm::vec3> reflection;
  Image<glm::vec4> color;
};

Drawn by_tracer(const Scene& scene, Workers& workers, const shared::ViewParams& view, glm::ivec2 size) {
  const Tracer tracer(scene.mesh);
  const TraceJob job{scene, tracer, workers, view};
  Drawn drawn{Image<std::uint32_t>(size), {}, {}, {}};
  trace_visibility(job, drawn.ids);
  trace_shadow_mask(job, drawn.ids, MaskImage::bits_for(static_cast<int>(casting_lights(scene).size())),
                    drawn.mask);
  trace_reflection(job, drawn.ids, 8, drawn.reflection);
  shade(job, drawn.ids, drawn.mask, drawn.reflection, drawn.color);
  return drawn;
}

// The float tracer's rounding moves shadow edges and mirrored silhouettes, nothing else.
TEST_P(ReferenceAgreement, TracerDrawsTheSame) {
  constexpr glm::ivec2 kSize{160, 120};
  const Scene scene = load_or_die(source_path(GetParam()));
  Workers workers(2);
  const shared::ViewParams view = view_params(first_camera_of(scene), kSize);
  const Drawn tracer = by_tracer(scene, workers, view, kSize);
  const ReferencePicture reference =
      reference_render(scene, {.camera = first_camera_of(scene), .size = kSize}, 8, workers);
  double sum = 0.0, largest = 0.0;
  int same_ids = 0, other_masks = 0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      if (tracer.ids.at(x, y) != reference.ids.at(x, y)) continue;
      ++same_ids;
      if (tracer.mask.get(x, y) != reference.mask.get(x, y)) ++other_masks;
      const glm::dvec3 apart =
          glm::abs(glm::dvec3(tracer.color.at(x, y)) - glm::dvec3(reference.color.at(x, y)));
      sum += (apart.x + apart.y + apart.z) / 3.0;
      largest = std::max({largest, apart.x, apart.y, apart.z});
    }
  const int pixels = kSize.x * kSize.y;
  std::printf("  %s: %d of %d other ids, %d other masks, mean difference %.2g, largest %.2g\n",
              GetParam().c_str(), pixels - same_ids, pixels, other_masks, sum / same_ids, largest);
  EXPECT_GT(same_ids, pixels * 999 / 1000);
  EXPECT_LT(other_masks, pixels / 1000);
  EXPECT_LT(sum / same_ids, 1.0 / 255.0);
}

}  // namespace
}  // namespace pinocchio
