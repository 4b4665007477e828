#include "pinocchio/scene.h"

#include <cmath>
#include <set>

#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string complaint_of(const Scene& scene) {
  const Expected<void> checked = check_scene(scene);
  return checked ? "" : checked.error().message();
}

// A kind without its row, or a row in another place, does not compile.
static_assert(kLightKinds.size() == static_cast<std::size_t>(Light::Kind::rectangle) + 1);
static_assert([] {
  for (std::size_t i = 0; i < kLightKinds.size(); ++i)
    if (kLightKinds[i].kind != static_cast<Light::Kind>(i)) return false;
  return true;
}());

TEST(LightKinds, EachHasANameAndASizeOfItsOwn) {
  std::set<std::string_view> names;
  for (const LightKind& kind : kLightKinds) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.gltf_type.empty()) << kind.name;
    EXPECT_TRUE(kind.has_position || kind.has_direction) << kind.name;
    EXPECT_NE(kind.has_sides, kind.size != nullptr) << kind.name;
    Light light;
    light.kind = kind.kind;
    EXPECT_EQ(light.has_size(), kind.has_sides) << kind.name;
    for (const LightSize& size : kLightSizes) {
      Light sized = light;
      sized.*size.value = 0.5f;
      EXPECT_EQ(sized.has_size(), kind.has_sides || kind.size == &size) << kind.name << " " << size.name;
    }
  }
}

TEST(Scene, CastingLightsAreInSceneOrder) {
  Scene scene;
  scene.lights = {point_light({0, 0, 0}, false), point_light({1, 0, 0}), point_light({2, 0, 0}, false),
                  point_light({3, 0, 0})};
  EXPECT_EQ(casting_lights(scene), (std::vector<int>{1, 3}));
}

TEST(Scene, CamerasAreFoundByName) {
  const Scene scene = plate_over_floor();
  ASSERT_NE(find_camera(scene, "above"), nullptr);
  EXPECT_EQ(find_camera(scene, "above")->eye, glm::vec3(0, 9, 6));
  EXPECT_EQ(find_camera(scene, "below"), nullptr);
}

TEST(Scene, TheCameraForTheWholeSceneSeesEveryVertex) {
  for (const float size : {1.0f, 1e-9f, 1e6f}) {
    MeshData mesh = *random_soup(200, 0.5f, 7).mesh;
    for (glm::vec3& p : mesh.positions) p *= size;
    const Scene scene(std::move(mesh));
    const Camera camera = camera_for_whole_scene(scene);
    EXPECT_LT(glm::length(camera.eye - camera.target), 5.0f * scene.mesh->bounds().diagonal());
    const CameraAxes axes = camera_axes(camera);
    const float edge = std::tan(glm::radians(0.5f * camera.fov_deg));
    for (const glm::vec3& p : scene.mesh->positions) {
      const glm::vec3 d = p - camera.eye;
      const float depth = glm::dot(d, axes.forward);
      ASSERT_GT(depth, 0.0f);
      EXPECT_LT(std::abs(glm::dot(d, axes.right)), edge * depth);
      EXPECT_LT(std::abs(glm::dot(d, axes.up)), edge * depth);
    }
    EXPECT_GT(camera.eye.y, camera.target.y);
  }
}

TEST(Scene, MovingALightCopiesNoGeometry) {
  const Scene scene = plate_over_floor();
  Scene relit = scene;
  relit.lights = {point_light({0, 5, 0})};
  drop_idle_casters(relit);
  EXPECT_EQ(relit.mesh, scene.mesh);
  EXPECT_EQ(scene.mesh->bounds().lo, glm::vec3(-4, 0, -4));
  EXPECT_EQ(scene.mesh->bounds().hi, glm::vec3(4, 1, 4));
}

TEST(Scene, DegenerateScenesGetACameraAndALight) {
  MeshData point;
  add_triangle(point, {1000, 0, 0}, {1000, 0, 0}, {1000, 0, 0});
  for (const Scene& scene : {Scene{}, Scene(point)}) {
    const Camera camera = camera_for_whole_scene(scene);
    EXPECT_TRUE(finite(camera.eye) && finite(camera.target));
    EXPECT_TRUE(finite(camera_axes(camera).right));
    EXPECT_TRUE(finite(default_light(scene, camera).position));
  }
}

TEST(Scene, TheDefaultLightIsAboveAndBesideTheEye) {
  const Scene scene = plate_over_floor();
  Camera camera = scene.cameras[0];
  const Light light = default_light(scene, camera);
  EXPECT_TRUE(light.casts_shadow);
  EXPECT_GT(light.position.y, camera.eye.y);
  EXPECT_GT(glm::dot(light.position - camera.eye, camera_axes(camera).right), 0.0f);
  camera.up = camera.target - camera.eye;  // looks along `up`
  EXPECT_TRUE(finite(default_light(scene, camera).position));
}

TEST(CheckScene, SaysWhatIsWrong) {
  const Scene good = plate_over_floor();
  EXPECT_EQ(complaint_of(good), "");
  EXPECT_NE(complaint_of(Scene{}).find("no triangles"), std::string::npos);
  Scene bad = good;
  MeshEdit(bad)->triangles[1].z = 99;
  EXPECT_NE(complaint_of(bad).find("triangle 1"), std::string::npos);
  bad = good;
  MeshEdit(bad)->triangle_materials[2] = 5;
  EXPECT_NE(complaint_of(bad).find("triangle 2"), std::string::npos);
  bad = good;
  MeshEdit(bad)->positions[3].y = std::nanf("");
  EXPECT_NE(complaint_of(bad).find("vertex 3"), std::string::npos);
  bad = good;
  MeshEdit(bad)->normals[4].x = INFINITY;
  EXPECT_NE(complaint_of(bad).find("vertex 4"), std::string::npos);
  bad = good;
  MeshEdit(bad)->normals.pop_back();
  EXPECT_NE(complaint_of(bad).find("one entry for each vertex or triangle"), std::string::npos);
  bad = good;
  MeshEdit(bad)->positions[0].x = -2.0f * kFarthest;
  EXPECT_NE(complaint_of(bad).find("scale the scene down"), std::string::npos);
  bad = good;
  MeshEdit(bad)->texcoords.assign(bad.mesh->positions.size(), glm::vec2(0.0f));
  EXPECT_EQ(complaint_of(bad), "");
  MeshEdit(bad)->texcoords[2].y = std::nanf("");
  EXPECT_NE(complaint_of(bad).find("texture coordinate of vertex 2"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
