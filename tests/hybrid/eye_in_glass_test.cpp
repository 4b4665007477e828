// An eye inside of glass: what it sees loses light on its way, by hand, and the same by every schedule and
// the reference.
#include <cmath>

#include "scenes/generator/mesh_builder.h"
#include "tests/hybrid/glass.h"

namespace pinocchio {
namespace {

// A wall that shines, seen from inside a slab of glass before it, and a thing in the same glass.
Scene from_inside(bool with_fly, bool open = false) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(glass(1.5f, true));
  if (open)
    builder.quad({4, -4, -1}, {-4, -4, -1}, {-4, 4, -1}, {4, 4, -1});  // its back is towards the eye
  else
    builder.box({-4, -4, -1}, {4, 4, 1});
  Material shining = matt(0.0f);
  shining.emission = glm::vec3(1.0f);
  builder.use(shining);
  builder.quad({-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3});
  if (with_fly) builder.quad({-1, -1, -0.5f}, {1, -1, -0.5f}, {1, 1, -0.5f}, {-1, 1, -0.5f});
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.cameras = {{"inside", {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 2.0f}};
  return scene;
}

void expect_seen(const Scene& scene, const glm::vec3& expected, const std::string& what) {
  expect_near(middle(precise(scene).color), expected, 2e-4f, what + ", reference");
  for (const Way& way : ways())
    expect_near(middle(drawn(scene, way.settings).color), expected, 6e-3f, what + ", " + way.name);
}

TEST(EyeInGlass, LightIsAbsorbedOnItsWayToTheEye) {
  // The wall before the eye mirrors what is behind the eye, where there is no light.
  const glm::vec3 way = absorbed(1.0f), seen = 0.96f * way;
  expect_seen(from_inside(false), seen, "through the wall");
  expect_seen(from_inside(true), absorbed(0.5f), "in the glass");
  Scene lit = from_inside(true);
  {
    MeshEdit mesh(lit);
    mesh->materials[1] = matt(1.0f);
  }
  Light light = point_light({0, 0, 0}, false);
  light.intensity = std::numbers::pi_v<float>;
  lit.lights = {light};
  expect_seen(lit, absorbed(0.5f), "by a light that casts none");
  lit.lights.front().casts_shadow = true;  // now the glass between light and thing counts, too
  expect_seen(lit, absorbed(1.0f), "by a light that casts");
}

TEST(EyeInGlass, OpenMeshesHaveNoInside) {
  expect_seen(from_inside(false, true), glm::vec3(0.96f), "a sheet seen from behind");
}

TEST(EyeInGlass, TheInnermostBodyCounts) {
  Scene scene = from_inside(true);
  {
    MeshEdit mesh(scene);
    MeshBuilder builder(*mesh);
    builder.use(glass(1.1f, false));
    builder.box({-0.2f, -0.2f, -0.25f}, {0.2f, 0.2f, 0.25f});
  }
  const float passed = 1.0f - std::pow(0.1f / 2.1f, 2.0f);
  // Behind the bubble the medium is unknown: the bubble ends at a clear side.
  expect_seen(scene, glm::vec3(passed), "a bubble around the eye");
}

TEST(EyeInGlass, CamerasWithoutOneEyeCountAsOutside) {
  Scene scene = from_inside(true);
  scene.cameras.front().projection = Projection::orthographic;
  expect_seen(scene, glm::vec3(1.0f), "orthographic");
}

}  // namespace
}  // namespace pinocchio
