// A moving scene whose lights and cameras were changed since it was loaded, saved and loaded again.
#include <algorithm>
#include <array>

#include "pinocchio/animation.h"
#include "pinocchio/save.h"
#include "tests/support/moving_gltf.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

// A triangle, and two cameras and two lights on nodes of their own, which move along x by 1, 2, 3 and 4.
Scene with_moving_cameras_and_lights() {
  Moving m;
  m.json["cameras"] = {
      {{"name", "near"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}},
      {{"name", "far"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  m.json["extensionsUsed"] = {"KHR_lights_punctual"};
  m.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"name", "key"}, {"type", "point"}}, {{"name", "fill"}, {"type", "spot"}, {"spot", Json::object()}}};
  for (int i = 1; i <= 4; ++i) {
    Json node{{"name", std::array{"near", "far", "key", "fill"}[static_cast<std::size_t>(i - 1)]}};
    if (i <= 2) {
      node["camera"] = i - 1;
    } else {
      node["extensions"]["KHR_lights_punctual"]["light"] = i - 3;
    }
    m.json["nodes"].push_back(node);
    m.json["scenes"][0]["nodes"].push_back(i);
    m.animate(i, "translation", {0, 1}, m.floats({0, 0, 0, static_cast<float>(i), 0, 0}, "VEC3"));
  }
  return load_good(m.json);
}

Scene saved_and_loaded(const Scene& scene, double seconds) {
  save_scene(scene, own_file("changed.gltf"));
  return at_time(load_or_die(own_file("changed.gltf")), seconds).value();
}

const Camera& camera_named(const Scene& scene, std::string_view name) {
  return *std::ranges::find(scene.cameras, name, &Camera::name);
}
const Light& light_named(const Scene& scene, std::string_view name) {
  return *std::ranges::find(scene.lights, name, &Light::name);
}

TEST(SaveMoving, WithFewerLightsAndCameras) {
  Scene scene = with_moving_cameras_and_lights();
  scene.cameras.erase(scene.cameras.begin());
  scene.lights.pop_back();
  const Scene loaded = saved_and_loaded(scene, 1);
  ASSERT_EQ(loaded.cameras.size(), 1u);
  EXPECT_EQ(camera_named(loaded, "far").eye, glm::vec3(2, 0, 0));
  ASSERT_EQ(loaded.lights.size(), 1u);
  EXPECT_EQ(light_named(loaded, "key").position, glm::vec3(3, 0, 0));
  scene.cameras.clear();
  scene.lights.clear();
  const Scene none = saved_and_loaded(scene, 1);
  EXPECT_TRUE(none.cameras.empty());
  EXPECT_TRUE(none.lights.empty());
}

// As the window does: its own camera comes first.
TEST(SaveMoving, WithMoreLightsAndCameras) {
  Scene scene = with_moving_cameras_and_lights();
  Camera own = scene.cameras.front();
  own.name = "window";
  own.eye = {7, 8, 9};
  own.target = {7, 8, 0};
  scene.cameras.insert(scene.cameras.begin(), own);
  Light lamp = point_light({5, 5, 5});
  lamp.name = "lamp";
  scene.lights.insert(scene.lights.begin(), lamp);
  scene.lights.push_back(lamp);
  const auto check = [](const Scene& moved) {
    ASSERT_EQ(moved.cameras.size(), 3u);
    EXPECT_EQ(moved.cameras.front().name, "window");
    EXPECT_EQ(moved.cameras.front().eye, glm::vec3(7, 8, 9));
    EXPECT_EQ(camera_named(moved, "near").eye, glm::vec3(1, 0, 0));
    EXPECT_EQ(camera_named(moved, "far").eye, glm::vec3(2, 0, 0));
    ASSERT_EQ(moved.lights.size(), 4u);
    EXPECT_EQ(moved.lights.front().position, glm::vec3(5, 5, 5));
    EXPECT_EQ(moved.lights.back().position, glm::vec3(5, 5, 5));
    EXPECT_EQ(light_named(moved, "key").position, glm::vec3(3, 0, 0));
    EXPECT_EQ(light_named(moved, "fill").position, glm::vec3(4, 0, 0));
  };
  check(at_time(scene, 1).value());
  check(saved_and_loaded(scene, 1));
}

TEST(SaveMoving, LightsAndCamerasThatWereReordered) {
  Scene scene = with_moving_cameras_and_lights();
  std::ranges::reverse(scene.cameras);
  std::ranges::reverse(scene.lights);
  for (const Scene& moved : {at_time(scene, 1).value(), saved_and_loaded(scene, 1)}) {
    ASSERT_EQ(moved.cameras.size(), 2u);
    EXPECT_EQ(camera_named(moved, "near").eye, glm::vec3(1, 0, 0));
    EXPECT_EQ(camera_named(moved, "far").eye, glm::vec3(2, 0, 0));
    EXPECT_EQ(light_named(moved, "key").position, glm::vec3(3, 0, 0));
    EXPECT_EQ(light_named(moved, "fill").position, glm::vec3(4, 0, 0));
  }
}

// A light that was placed by hand keeps that place, and still moves with its node.
TEST(SaveMoving, LightsAndCamerasThatWereMoved) {
  Scene scene = with_moving_cameras_and_lights();
  scene.lights[0].position += glm::vec3(0, 2, 0);
  scene.cameras[0].eye += glm::vec3(0, 0, 3);
  const Scene rest = saved_and_loaded(scene, 0), moved = saved_and_loaded(scene, 1);
  EXPECT_EQ(light_named(rest, "key").position, glm::vec3(0, 2, 0));
  EXPECT_EQ(light_named(moved, "key").position, glm::vec3(3, 2, 0));
  EXPECT_EQ(camera_named(rest, "near").eye, glm::vec3(0, 0, 3));
  EXPECT_EQ(camera_named(moved, "near").eye, glm::vec3(1, 0, 3));
}

}  // namespace
}  // namespace pinocchio
