// Points where shading normals face a light and facets do not: dark facets on coarse meshes, and, with the
// treatments, light at points that should be dark.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/one_ray/surface_at.h"
#include "bench/stability/count.h"
#include "bench/stability/shapes.h"

namespace pinocchio::stability {
namespace {

Light point_light(const glm::vec3& position) {
  Light light;
  light.position = position;
  return light;
}

// The hits of rays from the eye to points around the origin, on triangles below `end`.
std::vector<SurfaceInteraction> seen_points(const Tracer& tracer, const glm::vec3& eye, std::uint32_t end,
                                            int rays, FailureCount& count) {
  Random random(72);
  std::vector<Ray> primary;
  for (int i = 0; i < rays; ++i) primary.push_back({eye, kInfinity, random_point(random, 0.9f) - eye});
  const std::vector<Hit> hits = trace(tracer, primary, count);
  std::vector<SurfaceInteraction> points;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i].valid() && hits[i].triangle < end)
      points.push_back(
          surface_at(tracer.mesh(), hits[i].triangle, eye, primary[i].direction, tracer.offset()));
  return points;
}

// The number of points that the light reaches.
std::uint64_t count_lit(const Tracer& tracer, const std::vector<SurfaceInteraction>& points,
                        const Light& light, Terminator terminator, FailureCount& count) {
  const shared::LightParams params = light_params(light);
  std::vector<Ray> shadow, way_up;
  std::vector<std::size_t> lifted;
  for (const SurfaceInteraction& s : points) {
    const std::optional<Ray> ray = shadow_ray(params, s, glm::vec2(0.5f), terminator);
    const bool dark = terminator == Terminator::smoothed && ray &&
                      shared::terminator_factor(s.n_shading, s.n_geometric,
                                                glm::normalize(light.position - s.p_world)) <= 0.0f;
    if (!ray || dark) continue;
    if (const std::optional<Ray> up = lift_ray(params, s, glm::vec2(0.5f), terminator)) {
      way_up.push_back(*up);
      lifted.push_back(shadow.size());
    }
    shadow.push_back(*ray);
  }
  std::vector<std::uint8_t> blocked(shadow.size()), up_blocked(way_up.size());
  {
    const Timed timed(count);
    tracer.occluded(shadow, blocked);
    tracer.occluded(way_up, up_blocked);
  }
  for (std::size_t i = 0; i < lifted.size(); ++i) blocked[lifted[i]] |= up_blocked[i];
  return static_cast<std::uint64_t>(std::count(blocked.begin(), blocked.end(), 0));
}

// A ball is convex: every point where the smooth ball's normal faces the light is lit. Other points would
// show the facets as edges between light and dark.
FailureCount dark_facets(const Method& method, int rays) {
  FailureCount count;
  for (const int around : {6, 12, 24}) {
    const Tracer tracer = method.tracer(ball(glm::vec3(0.0f), 1.0f, around));
    for (const glm::vec3 position :
         {glm::vec3(10.0f, 0.5f, 0.5f), glm::vec3(-7.0f, 9.0f, -2.0f), glm::vec3(2.0f, -3.0f, 0.3f)}) {
      const Light light = point_light(position);
      std::vector<SurfaceInteraction> points = seen_points(tracer, {0, 0, 6}, kNoTriangle, rays / 9, count);
      std::erase_if(points, [&](const SurfaceInteraction& s) {
        return glm::dot(s.n_shading, position - s.p_world) <= 0.0f;
      });
      count.trials += points.size();
      count.failures += points.size() - count_lit(tracer, points, light, method.terminator, count);
    }
  }
  return count;
}

// `inner` inside closed walls, with a light outside: nothing is lit.
FailureCount behind_walls(const MeshData& inner, const MeshData& walls, const glm::vec3& eye,
                          const Method& method, int rays) {
  MeshData mesh = inner;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), walls.positions.begin(), walls.positions.end());
  mesh.normals.insert(mesh.normals.end(), walls.normals.begin(), walls.normals.end());
  for (const glm::uvec3& t : walls.triangles) mesh.triangles.push_back(t + first);
  mesh.triangle_materials.resize(mesh.triangles.size(), 0);
  const Tracer tracer = method.tracer(mesh);
  FailureCount count;
  for (const glm::vec3 position :
       {glm::vec3(9.0f, 1.0f, 0.5f), glm::vec3(0.5f, -8.0f, 1.0f), glm::vec3(3.0f, 4.0f, 5.0f)}) {
    const std::vector<SurfaceInteraction> points =
        seen_points(tracer, eye, static_cast<std::uint32_t>(tracer.mesh().triangles.size()), rays / 3, count);
    count.trials += points.size();
    count.failures += count_lit(tracer, points, point_light(position), method.terminator, count);
  }
  return count;
}

// A coarse ball that nearly touches the walls: its curved surface extends through them. The eye is between
// the two.
FailureCount tight_room(const Method& method, int rays) {
  const float side = 1.0f + 0x1p-7f;
  return behind_walls(ball(glm::vec3(0.0f), 1.0f, 12), box(glm::vec3(-side), glm::vec3(side), 4),
                      glm::vec3(0.95f * side), method, rays);
}

// A cube with eight normals that are means of its sides' normals, as after smoothing a whole mesh.
MeshData smoothed_cube(float half_side, bool inwards) {
  MeshData mesh = box(glm::vec3(-half_side), glm::vec3(half_side), 1);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.normals[i] = (inwards ? -1.0f : 1.0f) * glm::normalize(mesh.positions[i]);
  return mesh;
}

// Large triangles under a closed shell, at a tenth of its size.
FailureCount smoothed_cube_in_shell(const Method& method, int rays) {
  return behind_walls(smoothed_cube(1.0f, false), box(glm::vec3(-1.125f), glm::vec3(1.125f), 4),
                      glm::vec3(1.1f, 1.05f, 1.09f), method, rays);
}

// A room with smoothed walls; the eye is inside.
FailureCount smoothed_room(const Method& method, int rays) {
  FailureCount count;
  for (const bool inwards : {false, true})
    count += behind_walls(smoothed_cube(1.0f, inwards), {}, {0.25f, 0.125f, -0.25f}, method, rays / 2);
  return count;
}

// Normals that do not depend on the surface.
FailureCount inconsistent_normals(const Method& method, int rays) {
  MeshData room = box(glm::vec3(-1.0f), glm::vec3(1.0f), 4), body = ball(glm::vec3(0.0f), 0.5f, 12);
  Random random(73);
  for (MeshData* const mesh : {&room, &body})
    for (glm::vec3& n : mesh->normals) n = glm::normalize(random_point(random, 1.0f) + 1e-3f);
  FailureCount count = behind_walls(room, {}, {0.25f, 0.125f, -0.25f}, method, rays / 2);
  return count += behind_walls(body, box(glm::vec3(-0.625f), glm::vec3(0.625f), 4), {0.6f, 0.6f, 0.6f},
                               method, rays / 2);
}

constexpr std::array kTerminatorCases{
    StressCase{"shadow terminator", "dark points before the light", dark_facets},
    StressCase{"coarse ball in a tight room", "light leaks", tight_room},
    StressCase{"smoothed cube in a shell", "light leaks", smoothed_cube_in_shell},
    StressCase{"room of smoothed walls", "light leaks", smoothed_room},
    StressCase{"normals at random", "light leaks", inconsistent_normals},
};

}  // namespace

std::span<const StressCase> terminator_cases() {
  return kTerminatorCases;
}

}  // namespace pinocchio::stability
