// The double precision reference against closed forms.
#include "core/reference/reference.h"

#include <cmath>
#include <numbers>

#include "core/reference/reference_shading.h"
#include "core/reference/reference_surface.h"
#include "core/reference/reference_tree.h"
#include "core/trace/view/view_params.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{160, 120};

// What the reference draws of a scene's first camera.
struct Drawn : ReferencePicture {
  explicit Drawn(const Scene& scene, int depth = 0) : view(view_params(scene.cameras.front(), kSize)) {
    Workers workers(2);
    static_cast<ReferencePicture&>(*this) =
        reference_render(scene, {.camera = scene.cameras.front(), .size = kSize}, depth, workers);
  }

  shared::ViewParams view;
};

double distance_to_line(const glm::dvec3& point, const glm::dvec3& origin, const glm::dvec3& direction) {
  return glm::length(glm::cross(point - origin, direction)) / glm::length(direction);
}

// A tessellated ball's surface lies between the ball itself and the one that its flattest triangle
// touches: a ray closer to the centre than that must hit, one farther than the radius must not.
struct Ball {
  static constexpr int kAround = 256;
  glm::vec3 center;
  float radius;

  [[nodiscard]] double inner() const {
    return static_cast<double>(radius) * std::cos(std::numbers::sqrt2 * std::numbers::pi / kAround) *
           (1.0 - 1e-6);
  }
  [[nodiscard]] double outer() const { return static_cast<double>(radius) * (1.0 + 1e-6); }
};

// Pixels where the closed form says hit, and where it says miss; none may differ.
struct Verdicts {
  int hits = 0, misses = 0, within_tessellation = 0;

  void add(const Ball& ball, double distance, bool hit, const char* what, int x, int y) {
    if (distance < ball.inner()) {
      ++hits;
      EXPECT_TRUE(hit) << what << " at pixel " << x << ", " << y;
    } else if (distance > ball.outer()) {
      ++misses;
      EXPECT_FALSE(hit) << what << " at pixel " << x << ", " << y;
    } else {
      ++within_tessellation;
    }
  }
};

// A floor (triangles 0 and 1) at y = 0, a ball and a lamp above it.
Scene ball_over_floor(const Ball& ball) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(Material{});
  builder.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
  builder.sphere(ball.center, ball.radius, Ball::kAround);
  Scene scene(std::move(mesh));
  scene.lights = {point_light({0.5f, 6.0f, 0.25f})};
  scene.cameras = {{"", {0, 5, 9}, {0, 1, 0}, {0, 1, 0}, 50.0f}};
  return scene;
}

TEST(Reference, SphereHasItsSilhouette) {
  const Ball ball{{0, 2, 0}, 1.0f};
  const Drawn drawn(ball_over_floor(ball));
  Verdicts verdicts;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const ReferenceRay ray = reference_pixel_ray(drawn.view, x, y);
      const bool hit = drawn.ids.at(x, y) != kNoTriangle && drawn.ids.at(x, y) > 1;
      verdicts.add(ball, distance_to_line(glm::dvec3(ball.center), ray.origin, ray.direction), hit, "ball", x,
                   y);
    }
  EXPECT_GT(verdicts.hits, 500);
  EXPECT_GT(verdicts.misses, 500);
  EXPECT_LT(verdicts.within_tessellation, 10);
}

TEST(Reference, SphereThrowsItsShadow) {
  const Ball ball{{0, 2, 0}, 1.0f};
  const Scene scene = ball_over_floor(ball);
  const Drawn drawn(scene);
  const glm::dvec3 lamp(scene.lights.front().position);
  Verdicts verdicts;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      if (drawn.ids.at(x, y) > 1) continue;
      const ReferenceRay ray = reference_pixel_ray(drawn.view, x, y);
      const glm::dvec3 floor = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
      const bool dark = drawn.mask.get(x, y) == 0;
      verdicts.add(ball, distance_to_line(glm::dvec3(ball.center), floor, lamp - floor), dark, "shadow", x,
                   y);
    }
  EXPECT_GT(verdicts.hits, 200);
  EXPECT_GT(verdicts.misses, 500);
  EXPECT_LT(verdicts.within_tessellation, 20);
}

// A lit patch before a mirror in the plane x = 0 looks as if it were a patch behind it.
TEST(Reference, MirrorShowsAPatchWhereItsImageIs) {
  constexpr double kHalf = 0.25;
  const glm::dvec3 center(2.0, 0.5, -0.75);
  MeshData mesh;
  MeshBuilder builder(mesh);
  Material mirror;
  mirror.ambient = mirror.diffuse = glm::vec3(0.0f);
  mirror.reflectance = glm::vec3(1.0f);
  builder.use(mirror);
  builder.quad({0, -4, 4}, {0, -4, -4}, {0, 4, -4}, {0, 4, 4});
  Material lamp = mirror;
  lamp.reflectance = glm::vec3(0.0f);
  lamp.emission = glm::vec3(3.0f);
  builder.use(lamp);
  builder.quad({2, 0.25f, -1}, {2, 0.25f, -0.5f}, {2, 0.75f, -0.5f}, {2, 0.75f, -1});
  Scene scene(std::move(mesh));
  scene.cameras = {{"", {3, 0, 2.5f}, {0, 0.25f, 0}, {0, 1, 0}, 50.0f}};

  const Drawn drawn(scene, 1);
  int lit = 0, dark = 0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      if (drawn.ids.at(x, y) > 1) continue;  // not the mirror
      const ReferenceRay ray = reference_pixel_ray(drawn.view, x, y);
      const glm::dvec3 at = ray.origin + (-center.x - ray.origin.x) / ray.direction.x * ray.direction;
      const double outside = std::max(std::abs(at.y - center.y), std::abs(at.z - center.z)) - kHalf;
      if (std::abs(outside) < 1e-9) continue;
      ++(outside < 0.0 ? lit : dark);
      EXPECT_EQ(drawn.reflection.at(x, y), glm::vec3(outside < 0.0 ? 3.0f : 0.0f)) << x << ", " << y;
    }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 500);
}

// The ray that goes on refracted from where `ray` hits.
ReferenceRay through(const Mesh& mesh, const ReferenceTree& tree, const ReferenceRay& ray) {
  const ReferenceHit hit = tree.closest_hit(ray);
  EXPECT_TRUE(hit.valid());
  return reference_bounces(reference_surface(mesh, ray, hit))[1].ray;
}

TEST(Reference, SlabShiftsARayAsSnellSays) {
  constexpr double kIor = 1.5, kThickness = 2.0;
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(Material{});
  builder.quad({-90, -5, 90}, {90, -5, 90}, {90, -5, -90}, {-90, -5, -90});
  Material glass;
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = static_cast<float>(kIor);
  builder.use(glass);
  builder.box({-90, -1, -90}, {90, 1, 90});
  const Scene scene(std::move(mesh));
  const ReferenceTree tree(*scene.mesh);
  for (const double degrees : {0.0, 10.0, 45.0, 70.0, 85.0}) {
    const double angle = degrees * std::numbers::pi / 180.0, inside = std::asin(std::sin(angle) / kIor);
    const glm::dvec3 origin(0.125, 3.0, 0.375), direction(std::sin(angle), -std::cos(angle), 0.0);
    const ReferenceRay in_glass = through(*scene.mesh, tree, {origin, direction});
    const ReferenceRay out = through(*scene.mesh, tree, in_glass);
    const ReferenceHit hit = tree.closest_hit(out);
    ASSERT_LE(hit.triangle, 1u) << degrees;
    const glm::dvec3 point = reference_surface(*scene.mesh, out, hit).p_world;
    const double x = origin.x + (8.0 - kThickness) * std::tan(angle) + kThickness * std::tan(inside);
    EXPECT_NEAR(point.x, x, 1e-9 * x) << degrees;
    EXPECT_NEAR(point.y, -5.0, 1e-9) << degrees;
    EXPECT_NEAR(point.z, origin.z, 1e-9) << degrees;
  }
}

// A number in [0, 1) that depends on the position alone: neighbours agree about their corners.
float roughness_at(const glm::vec3& p) {
  const float x = std::abs(std::sin(12.9898f * p.x + 78.233f * p.y + 37.719f * p.z)) * 437.585f;
  return x - std::floor(x);
}

void add_jagged(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int rounds) {
  if (rounds == 0) {
    const auto pulled = [](const glm::vec3& p) { return p * (0.6f + 0.8f * roughness_at(p)); };
    add_triangle(mesh, pulled(a), pulled(b), pulled(c));
    return;
  }
  const glm::vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
  add_jagged(mesh, a, ab, ca, rounds - 1);
  add_jagged(mesh, ab, b, bc, rounds - 1);
  add_jagged(mesh, ca, bc, c, rounds - 1);
  add_jagged(mesh, ab, bc, ca, rounds - 1);
}

// Closed and full of spikes: an octahedron's faces cut in four, and every corner pulled in or out.
Mesh jagged_sphere() {
  MeshData mesh;
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f})
      for (const float z : {-1.0f, 1.0f}) add_jagged(mesh, {x, 0, 0}, {0, y, 0}, {0, 0, z}, 5);
  return Mesh(std::move(mesh));
}

TEST(Reference, NothingLeaksOutOfAJaggedSphere) {
  const Mesh mesh = jagged_sphere();
  const ReferenceTree tree(mesh);
  Random random(5);
  int leaks = 0;
  for (std::uint32_t k = 0; k < 100'000; ++k) {
    const glm::uvec3 t = mesh.triangles[k % mesh.triangles.size()];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double share = random.between(0.0f, 1.0f);
    const glm::dvec3 on_edge = share * a + (1.0 - share) * b;
    const glm::dvec3 aim = k % 3 == 0 ? a : k % 3 == 1 ? on_edge : (a + b + c) / 3.0;
    const glm::dvec3 origin = k % 2 == 0 ? glm::dvec3(0.0) : glm::dvec3(random_point(random, 0.2f));
    if (!tree.closest_hit({origin, aim - origin}).valid()) ++leaks;
  }
  EXPECT_EQ(leaks, 0);
}

TEST(Reference, OfCoincidentTrianglesTheLowestIdIsHit) {
  MeshData data;
  for (int i = 0; i < 20; ++i) add_triangle(data, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Mesh mesh(std::move(data));
  const ReferenceTree tree(mesh);
  for (const glm::dvec3& at : {glm::dvec3(0.25, 0.25, 0), glm::dvec3(0.0), glm::dvec3(0.5, 0.5, 0)})
    EXPECT_EQ(tree.closest_hit({at + glm::dvec3(0, 0, 1), {0, 0, -1}}).triangle, 0u);
}

TEST(Reference, OddRaysAndNoTrianglesHitNothing) {
  const Scene scene = plate_over_floor(), empty;
  const ReferenceTree tree(*scene.mesh);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tree.closest_hit({{0, 5, 0}, {0, 0, 0}}).valid());
  EXPECT_FALSE(tree.closest_hit({{0, 5, 0}, {0, kNan, 0}}).valid());
  EXPECT_FALSE(tree.closest_hit({{kNan, 5, 0}, {0, -1, 0}}).valid());
  EXPECT_FALSE(ReferenceTree(*empty.mesh).closest_hit({{0, 5, 0}, {0, -1, 0}}).valid());
  EXPECT_TRUE(tree.closest_hit({{0, 5, 0}, {0, -1, 0}}).valid());
}

// A white ball under an even sky is as bright as the sky; what is behind it and in a mirror is the sky
// itself.
TEST(Reference, AnEvenSkyIsSeenAndLights) {
  const glm::vec3 sky(0.5f, 1.0f, 8.0f);
  for (const bool brdf : {false, true})
    for (const float mirrored : {0.0f, 0.5f}) {
      MeshData mesh;
      MeshBuilder builder(mesh);
      Material white;
      white.brdf = brdf;
      white.diffuse = glm::vec3((1.0f - mirrored) * (brdf ? std::numbers::inv_pi_v<float> : 1.0f));
      white.reflectance = glm::vec3(mirrored);
      builder.use(white);
      builder.sphere(glm::vec3(0.0f), 1.0f, 96);
      Scene scene(std::move(mesh));
      scene.ambient_light = glm::vec3(0.0f);
      scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, sky));
      scene.cameras.resize(1);
      scene.cameras[0].eye = {0, 0, 3};
      scene.cameras[0].target = glm::vec3(0.0f);
      const Drawn drawn(scene, 1);
      glm::dvec3 sum(0.0);
      double count = 0.0;
      for (const glm::vec4& c : drawn.color.pixels()) {
        if (c.a == 0.0f) {
          ASSERT_LT(glm::length(glm::vec3(c) - sky), 1e-5f);
          continue;
        }
        sum += glm::dvec3(c);
        count += 1.0;
      }
      ASSERT_GT(count, 1000.0);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i] / count / static_cast<double>(sky[i]), 1.0, 0.005);
    }
}

}  // namespace
}  // namespace pinocchio
