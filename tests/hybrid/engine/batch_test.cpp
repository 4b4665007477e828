// Many pictures into arrays are, bit for bit, the pictures one by one; measured cameras on both processors.
#include "pinocchio/batch.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <new>

#include "tests/support/draw.h"

namespace {
// Allocations of all threads, counted while somebody asks.
std::atomic<std::size_t> allocations{0};
}  // namespace

// Not inlined, or GCC takes malloc and free for a pair that does not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{75, 50};  // no whole number of tiles
constexpr std::size_t kPixels = 75 * 50;

std::vector<Camera> cameras_of(const Scene& scene, int count) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    Camera camera = first_camera(scene);
    camera.eye.x += 0.05f * static_cast<float>(i);
    cameras.push_back(with_intrinsics(camera, {70.0, 64.0, 30.0 + i, 27.5}, kSize));
  }
  return cameras;
}

struct Arrays {
  explicit Arrays(std::size_t frames) {
    color.resize(frames * kPixels), depth.resize(frames * kPixels), position.resize(frames * kPixels);
    normal = albedo = reflection = position;
    ids.resize(frames * kPixels), objects = ids;
    mask.resize(frames * kPixels);
  }
  FrameArrays all() {
    return {color.data(), depth.data(),   position.data(), normal.data(),    albedo.data(),
            ids.data(),   objects.data(), mask.data(),     reflection.data()};
  }
  std::vector<glm::vec4> color;
  std::vector<float> depth;
  std::vector<glm::vec3> position, normal, albedo, reflection;
  std::vector<std::uint32_t> ids, objects;
  std::vector<std::uint8_t> mask;
};

template <class T>
bool same(const Image<T>& image, const std::vector<T>& all, std::size_t frame) {
  return std::equal(image.pixels().begin(), image.pixels().end(),
                    all.begin() + static_cast<std::ptrdiff_t>(frame * kPixels));
}

void expect_as_one_by_one(const Scene& scene, Settings settings) {
  settings.threads = 2;
  Engine engine;
  const std::vector<Camera> cameras = cameras_of(scene, 3);
  Arrays arrays(cameras.size());
  const Expected<RayCounts> drawn = render_many(engine, scene, cameras, kSize, settings, arrays.all());
  ASSERT_TRUE(drawn) << drawn.error().message();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const FrameResult frame = engine.render(scene, {.camera = cameras[i], .size = kSize}, settings).value();
    const SurfaceImages surfaces = surfaces_of(frame);
    EXPECT_TRUE(same(frame.color, arrays.color, i));
    EXPECT_TRUE(same(frame.ids, arrays.ids, i));
    if (!frame.reflection.empty()) {
      EXPECT_TRUE(same(frame.reflection, arrays.reflection, i));
    }
    EXPECT_TRUE(same(surfaces.z_eye, arrays.depth, i));
    EXPECT_TRUE(same(surfaces.p_world, arrays.position, i));
    EXPECT_TRUE(same(surfaces.n_shading, arrays.normal, i));
    EXPECT_TRUE(same(surfaces.albedo, arrays.albedo, i));
    Image<std::uint8_t> mask(kSize);
    unpack_mask(frame, mask.pixels().data());
    EXPECT_TRUE(same(mask, arrays.mask, i));
    for (std::size_t p = 0; p < kPixels; ++p)
      ASSERT_EQ(arrays.objects[i * kPixels + p], object_of(scene, frame.ids[p]));
  }
}

class Batch : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Batch, testing::ValuesIn(own_scenes()),
                         [](const auto& scene) { return "scene" + std::to_string(scene.index); });

TEST_P(Batch, IsThePicturesOneByOne) {
  const Scene scene = load_or_die(source_path(GetParam()));
  expect_as_one_by_one(scene, by({{"mode", "raytrace"}}));
  Settings samples = by({{"mode", "raytrace"}});
  samples.spp = 3;
  expect_as_one_by_one(scene, samples);
  expect_as_one_by_one(scene, {});  // not by the queue of tiles: the GPU has a part
  Settings coarse;
  coarse.mask_scale = 2;
  expect_as_one_by_one(scene, coarse);
}

TEST(BatchOutputs, WhatIsNotWantedIsNotTraced) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Engine engine;
  const std::vector<Camera> cameras = cameras_of(scene, 2);
  Arrays arrays(2);
  const RayCounts rays =
      render_many(engine, scene, cameras, kSize, by({{"mode", "raytrace"}}), {.ids = arrays.ids.data()})
          .value();
  EXPECT_EQ(rays.primary, 2 * kPixels);
  EXPECT_EQ(rays.shadow + rays.reflection + rays.refraction, 0u);
}

TEST(BatchOutputs, NothingIsAllocatedForAFrame) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Settings settings = by({{"mode", "raytrace"}});
  settings.threads = 1;  // which thread takes how much is the same every time
  Engine engine;
  Arrays arrays(64);
  const auto cost = [&](int frames) {
    const std::vector<Camera> cameras = cameras_of(scene, frames);
    const std::size_t before = allocations;
    EXPECT_TRUE(render_many(engine, scene, cameras, kSize, settings, arrays.all()));
    return allocations - before;
  };
  (void)cost(64);
  EXPECT_EQ(cost(64), cost(8));
}

TEST(BatchOutputs, EndWhenTheyAreCancelled) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Engine engine;
  Arrays arrays(2);
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)render_many(engine, scene, cameras_of(scene, 2), kSize, by({{"mode", "raytrace"}}),
                                 arrays.all(), &progress),
               Cancelled);
}

// Poses that are made while earlier ones are drawn: two pictures of one pose, one of the scene as it is, and
// the last one from the scene's own camera.
class Poses : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] NodeTransform turned(float degrees) const {
    const auto node = static_cast<int>(scene_.nodes->nodes.size()) - 1;
    const glm::mat4& local = scene_.nodes->nodes.back().local;
    return {node, glm::rotate(local, glm::radians(degrees), glm::vec3(0.0f, 0.0f, 1.0f))};
  }

  const Scene scene_ = load_or_die(source_path("scenes/windmill"));
  const std::vector<NodeTransform> a_{turned(20.0f)}, b_{turned(40.0f)};
  const std::vector<Camera> cameras_ = cameras_of(scene_, 4);
  const std::array<PosedPicture, 5> pictures_{PosedPicture{a_, cameras_[0]}, PosedPicture{a_, cameras_[1]},
                                              PosedPicture{{}, cameras_[2]}, PosedPicture{b_, cameras_[3]},
                                              PosedPicture{a_, std::size_t{0}}};
};
INSTANTIATE_TEST_SUITE_P(Modes, Poses, testing::Values("raytrace", "hybrid"));

TEST_P(Poses, AreThePicturesOneByOne) {
  Settings settings = by({{"mode", GetParam()}});
  settings.threads = 2;
  Engine engine, other;
  Arrays arrays(pictures_.size());
  const Expected<RayCounts> drawn = render_many(engine, scene_, pictures_, kSize, settings, arrays.all());
  ASSERT_TRUE(drawn) << drawn.error().message();
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const Scene now = posed(scene_, pictures_[i].pose).value();
    const auto* const camera = std::get_if<Camera>(&pictures_[i].camera);
    const FrameResult frame =
        other.render(now, {.camera = camera ? *camera : now.cameras.front(), .size = kSize}, settings)
            .value();
    EXPECT_TRUE(same(frame.color, arrays.color, i));
    EXPECT_TRUE(same(frame.ids, arrays.ids, i));
    EXPECT_TRUE(same(surfaces_of(frame).p_world, arrays.position, i));
  }
}

TEST_P(Poses, MotionLeadsToTheNextPicture) {
  const Settings settings = by({{"mode", GetParam()}});
  Engine engine;
  std::vector<glm::vec2> found(pictures_.size() * kPixels), wanted(kPixels);
  ASSERT_TRUE(render_many(engine, scene_, pictures_, kSize, settings, {.motion = found.data()}));
  for (std::size_t i = 0; i + 1 < pictures_.size(); ++i) {
    const Scene now = posed(scene_, pictures_[i].pose).value(),
                next = posed(scene_, pictures_[i + 1].pose).value();
    const auto* const camera = std::get_if<Camera>(&pictures_[i + 1].camera);
    const MotionTo to{next.mesh, camera ? *camera : next.cameras.front()};
    ASSERT_TRUE(render_many(engine, now, std::array{std::get<Camera>(pictures_[i].camera)}, kSize, settings,
                            {.motion = wanted.data()}, nullptr, std::array{to}));
    EXPECT_EQ(std::memcmp(wanted.data(), &found[i * kPixels], kPixels * sizeof wanted[0]), 0);
  }
  EXPECT_TRUE(
      std::all_of(found.end() - kPixels, found.end(), [](glm::vec2 m) { return m == glm::vec2(0.0f); }));
}

TEST(PosesInError, EndWithTheFirstThatCannotBe) {
  const Scene scene = load_or_die(source_path("scenes/windmill"));
  const std::vector<NodeTransform> bad{{1000, glm::mat4(1.0f)}};
  const std::array pictures{PosedPicture{{}, first_camera(scene)}, PosedPicture{bad, first_camera(scene)}};
  Engine engine;
  Arrays arrays(2);
  const Expected<RayCounts> drawn =
      render_many(engine, scene, pictures, kSize, by({{"mode", "raytrace"}}), arrays.all());
  ASSERT_FALSE(drawn);
  EXPECT_NE(drawn.error().message().find("1000"), std::string::npos) << drawn.error().message();
}

// A rasteriser and rays agree on what a camera off its axis sees but at a few edges.
TEST(MeasuredCamera, SeesTheSameOnBothProcessors) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Engine engine;
  const View view{.camera = cameras_of(scene, 2).back(), .size = kSize};
  const FrameResult rays = engine.render(scene, view, by({{"mode", "raytrace"}})).value();
  const FrameResult raster = engine.render(scene, view).value();
  std::size_t differing = 0;
  for (std::size_t i = 0; i < kPixels; ++i) differing += rays.ids[i] != raster.ids[i] ? 1 : 0;
  EXPECT_LE(differing, kPixels / 500);
}

}  // namespace
}  // namespace pinocchio
