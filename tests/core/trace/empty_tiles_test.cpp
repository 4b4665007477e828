// Tiles whose rays come near nothing are not traced, and black light is not written twice: every picture has
// the bits that it has otherwise.

#include "core/parallel/tiles.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/seen_tiles.h"
#include "core/trace/view/tile_frustum.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/animation.h"
#include "pinocchio/view.h"
#include "tests/support/copies.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{250, 190};

struct Drawn {
  Image<std::uint32_t> ids;
  Image<glm::vec4> color;
  RayCounts rays;
};

Drawn drawn(const TraceJob& job, bool all_rays) {
  Drawn result;
  TileOutputs out;
  out.size = kSize;
  out.ids = &result.ids;
  out.color = &result.color;
  if (all_rays) out.on_rays = [](const RayBatch&) {};
  result.rays = trace_tiles(job, out).rays;
  return result;
}

// Near and far, within the scene and beside it, through lenses of all lengths, along axes, and parallel.
Camera random_camera(const Bounds& bounds, Random& random, int i) {
  constexpr float kAxes[3] = {-1.0f, 0.0f, 1.0f};
  constexpr float kAway[] = {0.3f, 1.0f, 3.0f, 1e3f};
  Camera camera;
  const float size = bounds.diagonal();
  camera.eye = bounds.center() + kAway[i % 4] * random_point(random, size);
  camera.target = bounds.center() + random_point(random, i % 3 == 0 ? 2.0f * size : 0.3f * size);
  if (i % 5 == 0) {
    const auto along = [&] { return kAxes[static_cast<int>(random.between(0.0f, 2.99f))]; };
    const glm::vec3 way{along(), along(), along()};
    camera.target = camera.eye + (way == glm::vec3(0.0f) ? glm::vec3(0, 0, -1) : way);
  }
  const float away = glm::length(bounds.center() - camera.eye);
  const float whole = 2.0f * glm::degrees(std::atan(0.5f * size / away));
  camera.fov_deg = glm::clamp(whole * random.between(0.2f, 4.0f), 1e-3f, 170.0f);
  if (i % 7 == 0) {
    camera.projection = Projection::orthographic;
    camera.height = size * random.between(0.2f, 4.0f);
  }
  return camera;
}

struct Tiles {
  int all = 0, empty = 0, found = 0;
  int left_out = 0;  // beside the scene's box
};

Tiles expect_same_pictures(const Scene& scene, const Tracer& tracer, int cameras, std::uint64_t seed) {
  Workers workers(2);
  Random random(seed);
  Tiles tiles;
  const TileGrid grid(kSize);
  for (int i = 0; i < cameras; ++i) {
    const Camera camera = random_camera(scene.mesh->bounds(), random, i);
    const glm::ivec2 first = i % 4 == 1 ? glm::ivec2(130, 70) : glm::ivec2(0);
    const glm::ivec2 whole = i % 4 == 1 ? 2 * kSize : kSize;
    const glm::vec2 jitter = i % 2 == 0 ? glm::vec2(0.0f) : glm::vec2(1.4f, -1.4f);
    const TraceJob job{scene, tracer, workers, view_params(camera, whole, jitter, first)};
    const Drawn fast = drawn(job, false), all = drawn(job, true);
    EXPECT_TRUE(same_bits(fast.ids, all.ids)) << i;
    EXPECT_TRUE(same_bits(fast.color, all.color)) << i;
    EXPECT_EQ(fast.rays.primary, all.rays.primary);
    const PixelBox may_see = part_that_may_see(tracer.trees().bounds, job.view, kSize);
    const SeenTiles seen(all.ids, 1, grid, may_see);
    for (std::size_t t = 0; t < grid.count(); ++t) {
      bool empty = true;
      TileGrid::for_each_pixel(grid.tile(t), [&](int x, int y) { empty &= all.ids.at(x, y) == kNoTriangle; });
      EXPECT_EQ(seen.any(t), !empty) << i << " " << t;
      const glm::ivec2 at = grid.tile(t).lo;
      const bool within =
          glm::all(glm::lessThanEqual(may_see.lo, at)) && glm::all(glm::lessThan(at, may_see.hi));
      tiles.left_out += within ? 0 : 1;
      ++tiles.all;
      tiles.empty += empty ? 1 : 0;
      tiles.found += misses(TileFrustum(job.view, grid.tile(t)), tracer.trees()) ? 1 : 0;
    }
  }
  return tiles;
}

TEST(TileFrustum, PicturesAreTheSame) {
  std::vector<Scene> scenes{random_soup(300, 0.3f, 3), random_soup(2, 1.0f, 5)};
  for (const std::string& name : own_scenes()) scenes.push_back(load_or_die(source_path(name)));
  for (const Scene& scene : scenes) {
    const Tiles tiles = expect_same_pictures(scene, Tracer(scene.mesh), 60, 17);
    EXPECT_GT(tiles.found, tiles.empty / 2) << scene.mesh->triangles.size() << " triangles";
    EXPECT_GT(tiles.left_out, tiles.empty / 4);
    EXPECT_GT(tiles.all - tiles.empty, tiles.all / 20);
  }
}

TEST(TileFrustum, PicturesOfMovedPartsAreTheSame) {
  const Scene scene = load_or_die(source_path("scenes/windmill.glb"));
  std::shared_ptr<const Tracer> tracer;
  Scene pose = scene;
  for (const double seconds : {0.0, 0.4, 0.9, 1.3}) {
    pose = at_time(scene, seconds).value();
    tracer = std::make_shared<const Tracer>(pose, BuildOptions{}, std::nullopt, OffsetMethod::error_bound,
                                            tracer.get());
  }
  ASSERT_FALSE(tracer->trees().top.empty());
  const Tiles tiles = expect_same_pictures(pose, *tracer, 60, 23);
  EXPECT_GT(tiles.found, tiles.empty / 2);
}

TEST(TileFrustum, PicturesOfCopiesAreTheSame) {
  const Scene scene = load_copies();
  const Tracer tracer(scene, {}, std::nullopt, OffsetMethod::error_bound, nullptr);
  ASSERT_FALSE(tracer.trees().top.empty());
  const Tiles tiles = expect_same_pictures(scene, tracer, 60, 29);
  EXPECT_GT(tiles.found, tiles.empty / 2);
}

// A pixel wide strip of the scene's box beside a tile is not missed; two pixels away it is.
TEST(TileFrustum, KnowsAPixelMoreThanItsTile) {
  Camera camera;
  camera.eye = {0.0f, 0.0f, 10.0f};
  camera.projection = Projection::orthographic;
  camera.height = 100.0f;  // a unit is a pixel
  const TileFrustum frustum(view_params(camera, {100, 100}), {{32, 32}, {64, 64}});
  const auto column = [](float x) { return Bounds{{x, -1.0f, 0.0f}, {x + 0.1f, 1.0f, 1.0f}}; };
  const float right = 64.0f - 50.0f;  // the tile's right edge
  EXPECT_FALSE(frustum.misses(column(right - 1.0f)));
  EXPECT_FALSE(frustum.misses(column(right + 0.2f)));
  EXPECT_TRUE(frustum.misses(column(right + 1.0f)));
}

// Parts of a larger picture, one after the other into one image: what a tile mirrored before is not left
// there.
TEST(BlackTiles, AreThoseWithoutMirroredLight) {
  const Scene scene = load_or_die(source_path("scenes/two-lights.gltf"));
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  const TileGrid grid(kSize);
  Image<glm::vec3> kept;
  std::vector<std::uint8_t> black;
  int black_before_and_after = 0, black_after_light = 0;
  for (const glm::ivec2 first : {glm::ivec2(0), {16, 16}, {250, 190}, {500, 380}, {250, 190}, {0, 0}}) {
    const TraceJob job{scene, tracer, workers, view_params(scene.cameras.front(), 3 * kSize, {}, first)};
    const Image<std::uint32_t> ids = drawn(job, true).ids;
    const std::vector<std::uint8_t> before = black;
    Image<glm::vec3> expected;
    TileOutputs out;
    out.size = kSize;
    out.seen = &ids;
    out.depth = 3;
    out.reflection = &expected;
    trace_tiles(job, out);
    out.reflection = &kept;
    out.black_tiles = &black;
    trace_tiles(job, out);
    EXPECT_TRUE(same_bits(kept, expected));
    ASSERT_EQ(black.size(), grid.count());
    for (std::size_t i = 0; i < black.size(); ++i) {
      if (black[i] == 0) continue;
      TileGrid::for_each_pixel(grid.tile(i),
                               [&](int x, int y) { ASSERT_EQ(kept.at(x, y), glm::vec3(0.0f)); });
      if (!before.empty()) ++(before[i] != 0 ? black_before_and_after : black_after_light);
    }
  }
  EXPECT_GT(black_before_and_after, 0);
  EXPECT_GT(black_after_light, 0);
}

// A large picture, which is written past the caches, has the pixels of its parts, which are not. One thread,
// whose memory holds what a tile showed before.
TEST(EmptyTiles, ShowTheirBackgroundAlone) {
  using enum Background::Kind;
  const Scene scene = random_soup(40, 0.2f, 3);
  const Tracer tracer(scene.mesh);
  Workers workers(1);
  const Camera camera = camera_for_whole_scene(scene);
  const glm::ivec2 size = 3 * kSize;
  for (const Background::Kind kind : {color, transparent, studio, environment, transparent}) {
    const auto drawn_from = [&](glm::ivec2 first, glm::ivec2 part) {
      TraceJob job{scene, tracer, workers, view_params(camera, size, {}, first)};
      job.options.background = {kind, {0.1f, 0.2f, 0.3f}};
      Image<glm::vec4> picture;
      TileOutputs out;
      out.size = part;
      out.color = &picture;
      trace_tiles(job, out);
      return picture;
    };
    const Image<glm::vec4> whole = drawn_from({0, 0}, size);
    int empty = 0, black = 0;
    for (const glm::ivec2 first : {glm::ivec2(0), {250, 190}, {500, 0}, {500, 380}}) {
      const Image<glm::vec4> part = drawn_from(first, kSize);
      for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
          const glm::vec4 pixel = part.at(x, y);
          ASSERT_EQ(whole.at(first.x + x, first.y + y), pixel);
          if (pixel.a != 0.0f) continue;
          ++empty;
          black += glm::vec3(pixel) == glm::vec3(0.0f) ? 1 : 0;
        }
    }
    EXPECT_GT(empty, kSize.x * kSize.y);
    EXPECT_EQ(black, kind == transparent || kind == environment ? empty : 0);
  }
}

}  // namespace
}  // namespace pinocchio
