#include "pinocchio/studio.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr float kFill = 0.85f;     // of the shorter side
constexpr float kFov_deg = 35.0f;  // of the shorter side
const glm::vec3 kTowardsEye = glm::normalize(glm::vec3(0.5f, 0.35f, 1.0f));

// What may be the surroundings of the rest: all triangles of a node with one material.
struct Surroundings {
  Bounds bounds;
  std::vector<std::uint32_t> triangles;
};

std::vector<Surroundings> parts_of(const Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  std::map<std::pair<int, std::uint32_t>, Surroundings> parts;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Surroundings& part = parts[{scene.nodes ? scene.nodes->node_of(i) : -1, mesh.triangle_materials[i]}];
    part.triangles.push_back(i);
    for (int k = 0; k < 3; ++k) part.bounds.add(mesh.positions[mesh.triangles[i][k]]);
  }
  std::vector<Surroundings> all;
  for (auto& [key, part] : parts) all.push_back(std::move(part));
  return all;
}

Bounds bounds_without(const std::vector<Surroundings>& parts, const Surroundings& without) {
  Bounds rest;
  for (const Surroundings& part : parts)
    if (&part != &without) {
      rest.add(part.bounds.lo);
      rest.add(part.bounds.hi);
    }
  return rest;
}

// A flat part on which the rest stands and beyond which it does not reach.
bool is_ground(const Bounds& part, const Bounds& rest) {
  constexpr float kFlat = 0.05f;  // of its width
  const glm::vec3 size = part.hi - part.lo, other = rest.hi - rest.lo;
  const float width = std::min(size.x, size.z);
  return size.y <= kFlat * width && other.y > 2.0f * size.y && rest.lo.y >= part.lo.y - 0.05f * other.y &&
         rest.lo.x >= part.lo.x && rest.hi.x <= part.hi.x && rest.lo.z >= part.lo.z && rest.hi.z <= part.hi.z;
}

// A part around the rest whose triangles face it.
bool is_sky(const Mesh& mesh, const Surroundings& part, const Bounds& rest) {
  constexpr float kLarger = 2.0f;
  if (part.bounds.diagonal() < kLarger * rest.diagonal()) return false;
  for (int axis : {0, 2})
    if (rest.lo[axis] < part.bounds.lo[axis] || rest.hi[axis] > part.bounds.hi[axis]) return false;
  if (rest.hi.y > part.bounds.hi.y) return false;
  double inwards = 0.0, all = 0.0;
  for (const std::uint32_t i : part.triangles) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    all += glm::length(area);
    if (glm::dot(area, glm::dvec3(rest.center()) - a) > 0.0) inwards += glm::length(area);
  }
  return inwards > 0.9 * all;
}

// The corners of the triangles that the picture is of; the origin if there are none.
std::vector<glm::vec3> corners_of_object(const Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  std::vector<Surroundings> parts = parts_of(scene);
  for (bool found = true; found && parts.size() > 1;) {
    found = false;
    const auto largest = std::ranges::max_element(
        parts, {}, [](const Surroundings& part) { return glm::length(part.bounds.hi - part.bounds.lo); });
    const Bounds rest = bounds_without(parts, *largest);
    if (is_ground(largest->bounds, rest) || is_sky(mesh, *largest, rest)) {
      parts.erase(largest);
      found = true;
    }
  }
  std::vector<bool> seen(mesh.positions.size());
  std::vector<glm::vec3> corners;
  for (const Surroundings& part : parts)
    for (const std::uint32_t i : part.triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.triangles[i][k];
        if (seen[vertex]) continue;
        seen[vertex] = true;
        corners.push_back(mesh.positions[vertex]);
      }
  if (corners.empty()) corners.emplace_back(0.0f);
  return corners;
}

// The extent of points along one axis of the picture, seen from `eye`: least and largest slope.
struct Slopes {
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  void add(double slope) {
    least = std::min(least, slope);
    largest = std::max(largest, slope);
  }
  [[nodiscard]] double middle() const { return 0.5 * (least + largest); }
};

Light key_light() {
  Light key;
  key.name = "studio";
  key.kind = Light::Kind::directional;
  key.direction = -glm::normalize(glm::vec3(-0.35f, 0.9f, 0.75f));
  key.intensity = 0.6f;
  return key;
}

Bounds bounds_of(const std::vector<glm::vec3>& points) {
  Bounds bounds;
  for (const glm::vec3& p : points) bounds.add(p);
  return bounds;
}

// Points on the outline of what the corners sweep when they turn around the vertical axis through `center`.
std::vector<glm::vec3> turned_around(const std::vector<glm::vec3>& corners, const glm::dvec3& center) {
  constexpr int kUpwards = 32, kAround = 64;
  std::vector<glm::dvec2> profile;  // how far from the axis and how high the corners are
  for (const glm::vec3& p : corners) {
    const glm::dvec3 q = glm::dvec3(p) - center;
    profile.emplace_back(glm::length(glm::dvec2(q.x, q.z)), q.y);
  }
  std::vector<glm::vec3> outline;
  for (int i = 0; i <= kUpwards; ++i) {
    const double up = glm::pi<double>() * (1.0 * i / kUpwards - 0.5);
    const glm::dvec2 direction(std::cos(up), std::sin(up));
    const glm::dvec2 furthest =
        *std::ranges::max_element(profile, {}, [&](const glm::dvec2& at) { return glm::dot(direction, at); });
    for (int k = 0; k < kAround; ++k) {
      const double turn = glm::two_pi<double>() * k / kAround;
      const glm::dvec3 q(furthest.x * std::cos(turn), furthest.y, furthest.x * std::sin(turn));
      outline.emplace_back(center + q);
    }
  }
  return outline;
}

// A camera towards `center` whose picture of `size` pixels the corners fill.
Camera fitted(const std::vector<glm::vec3>& corners, const glm::dvec3& center, glm::ivec2 size) {
  // At least what single precision distinguishes from the centre: eye and target have to differ. Scenes of
  // molecules are in units of 1e-10.
  const double least = std::max(1e-6 * glm::length(center), 1e-12);
  Camera camera;
  camera.name = "studio";
  const double portrait = std::max(1.0, 1.0 * size.y / size.x);  // the field of view is the picture's height
  camera.fov_deg = as_float(glm::degrees(2.0 * std::atan(portrait * std::tan(glm::radians(0.5 * kFov_deg)))));
  camera.target = glm::vec3(0.0f);
  camera.eye = kTowardsEye;
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 right(axes.right), up(axes.up), forward(axes.forward);
  const double slope = kFill * std::tan(glm::radians(0.5 * kFov_deg));

  // The four planes through the eye that touch the points: |x| <= slope z for all of them.
  double reach[4] = {-1e300, -1e300, -1e300, -1e300};
  for (const glm::vec3& p : corners) {
    const glm::dvec3 q = glm::dvec3(p) - center;
    const double x = glm::dot(q, right), y = glm::dot(q, up), z = slope * glm::dot(q, forward);
    const double beyond[4] = {x - z, -x - z, y - z, -y - z};
    for (int i = 0; i < 4; ++i) reach[i] = std::max(reach[i], beyond[i]);
  }
  const double distance =
      std::max({0.5 * (reach[0] + reach[1]) / slope, 0.5 * (reach[2] + reach[3]) / slope, least / slope});
  double x = 0.5 * (reach[0] - reach[1]), y = 0.5 * (reach[2] - reach[3]);
  // Where a side has room to spare, the silhouette goes to the middle.
  for (int i = 0; i < 3; ++i) {
    Slopes across, along;
    double nearest = 1e300;
    for (const glm::vec3& p : corners) {
      const glm::dvec3 q = glm::dvec3(p) - center;
      const double z = distance + glm::dot(q, forward);
      if (!(z > 0.0)) continue;
      nearest = std::min(nearest, z);
      across.add((glm::dot(q, right) - x) / z);
      along.add((glm::dot(q, up) - y) / z);
    }
    if (nearest == 1e300) break;
    x += across.middle() * distance;
    y += along.middle() * distance;
  }
  const glm::dvec3 target = center + x * right + y * up;
  camera.target = glm::vec3(target);
  camera.eye = glm::vec3(target - distance * forward);
  return camera;
}

}  // namespace

Camera studio_camera(const Scene& scene, glm::ivec2 size) {
  const std::vector<glm::vec3> corners = corners_of_object(scene);
  return fitted(corners, glm::dvec3(bounds_of(corners).center()), size);
}

Camera studio_turntable(const Scene& scene, glm::ivec2 size) {
  const std::vector<glm::vec3> corners = corners_of_object(scene);
  const glm::dvec3 center(bounds_of(corners).center());
  Camera camera = fitted(turned_around(corners, center), center, size);
  // The target moves along the view to the axis, which the view meets.
  const glm::dvec3 eye(camera.eye), towards = glm::dvec3(camera.target) - eye;
  const glm::dvec2 across(towards.x, towards.z), to_axis(center.x - eye.x, center.z - eye.z);
  const double way = glm::dot(to_axis, across) / glm::dot(across, across);
  if (way > 0.0) camera.target = glm::vec3(center.x, eye.y + way * towards.y, center.z);
  return camera;
}

std::shared_ptr<const Environment> studio_sky() {
  static const std::shared_ptr<const Environment> kSky = [] {
    constexpr glm::ivec2 kSize{128, 64};
    constexpr double kFloor = 0.1, kHorizon = 0.25, kZenith = 0.5;
    // Soft boxes, which metals mirror. They are above what a studio_camera sees behind the object.
    struct Box {
      glm::dvec3 towards;
      double radiance, sharpness;
    };
    const Box boxes[] = {{glm::normalize(glm::dvec3(-0.6, 0.7, 0.8)), 1.6, 14.0},
                         {glm::normalize(glm::dvec3(1.0, 0.6, 0.3)), 1.0, 18.0},
                         {glm::normalize(glm::dvec3(-0.3, 1.0, -0.6)), 1.0, 18.0}};
    Image<glm::vec3> sky(kSize);
    for (int row = 0; row < kSize.y; ++row)
      for (int column = 0; column < kSize.x; ++column) {
        // In double precision and rounded, so that every machine has the same sky.
        const double down = glm::pi<double>() * (row + 0.5) / kSize.y;
        const double turn = glm::two_pi<double>() * (0.5 - (column + 0.5) / kSize.x);
        const glm::dvec3 d(std::sin(down) * std::sin(turn), std::cos(down), std::sin(down) * std::cos(turn));
        double light =
            glm::mix(kHorizon, d.y > 0.0 ? kZenith : kFloor, glm::smoothstep(0.0, 1.0, std::abs(d.y)));
        for (const Box& box : boxes)
          light += box.radiance * std::exp(box.sharpness * (glm::dot(d, box.towards) - 1.0));
        sky.at(column, row) = glm::vec3(as_float(light));
      }
    return std::make_shared<const Environment>(std::move(sky));
  }();
  return kSky;
}

void add_studio_light(Scene& scene) {
  scene.environment = studio_sky();
  scene.lights.push_back(key_light());
}

bool has_studio_light(const Scene& scene) {
  return has_studio_sky(scene) && scene.lights.size() == 1 && scene.lights.front() == key_light();
}

bool has_studio_sky(const Scene& scene) {
  return scene.environment == studio_sky();
}

}  // namespace pinocchio
