// What pixels see, in lanes, against surfaces made one at a time.
#include "core/trace/tiles/aov.h"

#include <gtest/gtest.h>

#include "bench/one_ray/passes.h"
#include "bench/one_ray/surface_at.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/view.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kLayerSize{75, 45};  // tiles that are cut off on both sides

struct Points {
  Image<float> depth{kLayerSize, kInfinity};
  Image<glm::vec3> position{kLayerSize}, normal{kLayerSize}, albedo{kLayerSize};
};

Points one_by_one(const Scene& scene, const shared::ViewParams& view, const Image<std::uint32_t>& ids) {
  Points points;
  for (int y = 0; y < kLayerSize.y; ++y)
    for (int x = 0; x < kLayerSize.x; ++x) {
      if (ids.at(x, y) == kNoTriangle) continue;
      const Ray ray = pixel_ray(view, x, y);
      const SurfaceInteraction s =
          surface_at(*scene.mesh, ids.at(x, y), ray.origin, ray.direction, {}, Footprint::of_camera(view));
      points.depth.at(x, y) = glm::dot(s.p_world - view.eye, view_axis(view));
      points.position.at(x, y) = s.p_world;
      points.normal.at(x, y) = s.n_shading;
      const shared::ShadingParams& m = s.material.shading;
      points.albedo.at(x, y) = m.ggx_alpha > 0.0f ? m.ambient : m.diffuse;
    }
  return points;
}

Points in_lanes(const VisibleScene& of, const Image<std::uint32_t>& ids) {
  Points points;
  FrameArrays to;
  to.depth = points.depth.pixels().data();
  to.position = points.position.pixels().data();
  to.normal = points.normal.pixels().data();
  to.albedo = points.albedo.pixels().data();
  const TileGrid grid(kLayerSize);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const PixelBox tile = grid.tile(i);
    write_visible_points(of, tile, &ids.at(tile.lo.x, tile.lo.y), kLayerSize.x, to,
                         ids.index(tile.lo.x, tile.lo.y), kLayerSize.x);
  }
  return points;
}

TEST(VisiblePoints, AreTheSurfacesToTheBitAtEveryWidth) {
  for (const std::string name : {"scenes/two-lights.gltf", "scenes/speedboat.glb", "scenes/terrace.glb"}) {
    const Scene scene = load_or_die(source_path(name));
    const Tracer tracer(scene.mesh);
    Workers workers(1);
    const shared::ViewParams view = view_params(scene.cameras.front(), kLayerSize);
    Image<std::uint32_t> ids(kLayerSize);
    trace_visibility({scene, tracer, workers, view}, ids);
    const LaneMapsOf maps(*scene.mesh);
    const SceneArrays arrays = SceneArrays::of(*scene.mesh, maps);
    const Points expected = one_by_one(scene, view, ids);
    for (const Isa isa : supported_isas()) {
      SCOPED_TRACE(name + " " + std::string(isa_name(isa)));
      const Points points = in_lanes({arrays, lane_steps(isa), view}, ids);
      EXPECT_TRUE(same_bits(points.depth, expected.depth));
      EXPECT_TRUE(same_bits(points.position, expected.position));
      EXPECT_TRUE(same_bits(points.normal, expected.normal));
      EXPECT_TRUE(same_bits(points.albedo, expected.albedo));
    }
  }
}

// Arrays that are not wanted are not written; the others are written in the tile only.
TEST(VisiblePoints, WritesWhatIsWantedAlone) {
  const Scene scene = load_or_die(source_path("scenes/two-lights.gltf"));
  const Image<std::uint32_t> ids(kLayerSize, 0u);
  std::vector<float> depth(3 * 10, -1.0f);
  FrameArrays to;
  to.depth = depth.data();
  const shared::ViewParams view = view_params(scene.cameras.front(), kLayerSize);
  const LaneMapsOf maps(*scene.mesh);
  const SceneArrays arrays = SceneArrays::of(*scene.mesh, maps);
  write_visible_points({arrays, lane_steps(default_isa()), view}, {{4, 4}, {7, 6}}, &ids.at(4, 4),
                       kLayerSize.x, to, 2, 10);
  for (std::size_t i = 0; i < depth.size(); ++i)
    EXPECT_EQ(depth[i] == -1.0f, i / 10 > 1 || i % 10 < 2 || i % 10 > 4) << i;
}

}  // namespace
}  // namespace pinocchio
