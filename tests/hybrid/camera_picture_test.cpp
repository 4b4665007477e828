// Pictures by cameras that are no pinholes: by every processor that draws them, and by the reference.
#include <cmath>

#include "core/reference/reference.h"
#include "tests/support/draw.h"
#include "tests/support/source_path.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kCameraSize{160, 120};

Scene scene_named(const std::string& name) {
  Scene scene = load_scene(PINOCCHIO_SOURCE_DIR "/scenes/" + name).value();
  scene.cameras = {first_camera(scene)};
  return scene;
}

Scene orthographic(const std::string& name) {
  Scene scene = scene_named(name);
  Camera& camera = scene.cameras.front();
  camera.projection = Projection::orthographic;
  camera.height =
      glm::distance(camera.eye, camera.target) * std::tan(glm::radians(0.5f * camera.fov_deg)) * 2.0f;
  return scene;
}

// Pixels of other triangles, and the largest difference of the others' colour.
struct Difference {
  int ids = 0;
  float color = 0.0f;
};
Difference difference(const FrameResult& a, const Image<std::uint32_t>& ids, const Image<glm::vec4>& color) {
  Difference all;
  for (std::size_t i = 0; i < ids.pixels().size(); ++i) {
    if (a.ids[i] != ids[i]) {
      ++all.ids;
      continue;
    }
    for (int c = 0; c < 4; ++c)  // design 2's picture travels clipped at white
      all.color = std::max(all.color, std::abs(std::min(a.color[i][c], 1.0f) - std::min(color[i][c], 1.0f)));
  }
  return all;
}

// Both processors, and both together, in whole pictures and in parts.
TEST(OrthographicPictures, AreTheSameByGpuAndCpu) {
  for (const char* const name : {"two-lights", "cornell", "speedboat"})
    for (const PixelBox& part : {PixelBox{}, PixelBox{{31, 20}, {130, 101}}}) {
      const Scene scene = orthographic(name);
      const FrameResult cpu =
          draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kCameraSize, .part = part});
      const auto seen =
          std::ranges::count_if(cpu.ids.pixels(), [](std::uint32_t id) { return id != kNoTriangle; });
      EXPECT_GT(seen, 500) << name;
      Settings reproject = by({{"design", "1"}});
      reproject.exchange = Exchange::reproject;
      for (const Settings& by_gpu : {by({{"design", "1"}}), by({{"design", "2"}}), reproject}) {
        const FrameResult both = draw_one(scene, {.settings = by_gpu, .size = kCameraSize, .part = part});
        const Difference found = difference(both, cpu.ids, cpu.color);
        EXPECT_LE(found.ids, 20) << name;
        EXPECT_LE(found.color, 0.02f) << name;
      }
    }
}

TEST(OrthographicPictures, AreTheReferences) {
  for (const char* const name : {"two-lights", "cornell"}) {
    const Scene scene = orthographic(name);
    const FrameResult cpu = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kCameraSize});
    Workers workers(2);
    const ReferencePicture truth = reference_render(scene, {scene.cameras.front(), kCameraSize}, 8, workers);
    const Difference found = difference(cpu, truth.ids, truth.color);
    EXPECT_LE(found.ids, 10) << name;
    int far = 0;  // at edges of shadows and mirrored edges
    for (std::size_t i = 0; i < truth.ids.pixels().size(); ++i)
      far += glm::length(cpu.color[i] - truth.color[i]) > 0.01f ? 1 : 0;
    EXPECT_LE(far, 40) << name;
  }
}

// Cameras that OpenGL does not draw: the reference draws them too.
TEST(RayPictures, AreTheReferences) {
  Scene scene = scene_named("two-lights");
  Workers workers(2);
  for (const Projection projection : {Projection::panorama, Projection::fisheye, Projection::perspective}) {
    Camera& camera = scene.cameras.front();
    camera.projection = projection;
    if (projection == Projection::fisheye) camera.fov_deg = 200.0f;
    if (projection == Projection::perspective) camera.fov_deg = 50.0f, camera.distortion = {-0.3f, 0.1f};
    const FrameResult cpu = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kCameraSize});
    const ReferencePicture truth = reference_render(scene, {camera, kCameraSize}, 8, workers);
    const Difference found = difference(cpu, truth.ids, truth.color);
    EXPECT_LE(found.ids, 10) << as_int(projection);
    int far = 0, seen = 0;  // at edges of shadows and mirrored edges
    for (std::size_t i = 0; i < truth.ids.pixels().size(); ++i) {
      far += glm::length(cpu.color[i] - truth.color[i]) > 0.01f ? 1 : 0;
      seen += truth.ids[i] != kNoTriangle ? 1 : 0;
    }
    EXPECT_LE(far, 40) << as_int(projection);
    EXPECT_GT(seen, 500) << as_int(projection);
  }
}

// A picture from the rays of a camera is the camera's picture.
TEST(RayPictures, OfACamerasRaysAreItsPicture) {
  for (const Projection projection :
       {Projection::perspective, Projection::orthographic, Projection::panorama, Projection::fisheye}) {
    Scene scene = orthographic("cornell");
    scene.cameras.front().projection = projection;
    Engine engine;
    Settings settings = by({{"mode", "raytrace"}});
    settings.filter_textures = false;
    const View by_camera{.camera = scene.cameras.front(), .size = kCameraSize};
    const FrameResult expected = engine.render(scene, by_camera, settings).value();
    View by_rays = by_camera;
    auto rays = std::make_shared<PixelRays>();
    const Image<Ray> of_camera = camera_rays(by_camera);
    for (const Ray& ray : of_camera.pixels()) {
      rays->origins.push_back(ray.origin);
      rays->directions.push_back(ray.direction);
    }
    by_rays.rays = rays;
    by_rays.camera = {};
    const FrameResult found = engine.render(scene, by_rays, settings).value();
    EXPECT_TRUE(same_pixels(found, expected)) << kProjectionNames[static_cast<std::size_t>(projection)];
  }
}

// OpenGL is not even opened.
TEST(RayPictures, GoToTheCpuByThemselves) {
  Scene scene = scene_named("two-lights");
  Engine engine(EngineOptions{.device = "no such device"});
  for (const Projection projection : {Projection::panorama, Projection::fisheye}) {
    Camera camera = scene.cameras.front();
    camera.projection = projection;
    const auto picture =
        engine.render(scene, {.camera = camera, .size = kCameraSize}, by({{"mode", "hybrid"}}));
    ASSERT_TRUE(picture) << picture.error().message();
    EXPECT_FALSE(picture->settings.uses_gpu());
    const auto seen =
        std::ranges::count_if(picture->ids.pixels(), [](std::uint32_t id) { return id != kNoTriangle; });
    EXPECT_GT(seen, 100);
  }
}

// Depth is the distance; a point at depth along the ray is the position.
TEST(RayPictures, DepthOfAFisheyeIsTheDistance) {
  Scene scene = scene_named("two-lights");
  Camera& camera = scene.cameras.front();
  camera.projection = Projection::fisheye;
  camera.fov_deg = 120.0f;
  const FrameResult picture = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kCameraSize});
  const SurfaceImages surfaces = surfaces_of(picture);
  const Image<Ray> rays = camera_rays(picture.view);
  for (std::size_t i = 0; i < surfaces.z_eye.pixels().size(); ++i) {
    if (picture.ids[i] == kNoTriangle) continue;
    const glm::vec3 at = rays[i].origin + surfaces.z_eye[i] * rays[i].direction;
    EXPECT_LT(glm::distance(at, surfaces.p_world[i]), 1e-4f * surfaces.z_eye[i]);
  }
}

// A floor with a checkerboard: near the horizon of a panorama, filtered texels are grey.
TEST(RayPictures, TexturesAreAveragedOverThePixelsOfTheModel) {
  const Scene textured = scene_named("terrace");
  Camera camera = textured.cameras.front();
  camera.projection = Projection::panorama;
  Engine engine;
  Settings one = by({{"mode", "raytrace"}}), many = one;
  many.spp = 64;
  Settings unfiltered = one;
  unfiltered.filter_textures = false;
  const View view{.camera = camera, .size = {128, 64}};
  const Image<glm::vec4> truth = engine.render(textured, view, many)->color;
  const auto error = [&](const Settings& settings) {
    const Image<glm::vec4> color = engine.render(textured, view, settings)->color;
    double sum = 0.0;
    for (std::size_t i = 0; i < color.pixels().size(); ++i)
      sum += glm::dot(color[i] - truth[i], color[i] - truth[i]);
    return sum;
  };
  EXPECT_LT(error(one), 0.9 * error(unfiltered));
}

}  // namespace
}  // namespace pinocchio
