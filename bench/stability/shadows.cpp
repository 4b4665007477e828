// Shadow rays at every scale: convex bodies do not shadow themselves, and no light enters closed rooms.
#include <array>
#include <cmath>

#include "bench/one_ray/surface_at.h"
#include "bench/stability/count.h"
#include "bench/stability/shapes.h"
#include "pinocchio/nodes.h"

namespace pinocchio::stability {
namespace {

// Powers of two, so that a shape and its copy have the same corners to the last bit.
constexpr std::array kScales{0x1p-20f, 0x1p-10f, 1.0f, 0x1p10f, 0x1p20f};
constexpr std::array kMoves{0x1p10f, 0x1p20f};  // sizes away from the origin

struct Set {
  MeshData mesh;
  glm::vec3 eye{0.0f};
  Light light{};
  glm::vec3 center{0.0f};
  float half_side = 0.0f;  // of the room
  float clear = 0.0f;      // points nearer than this to the room's other sides are not tested; 0: all are
};

// Whether the point is farther than `clear` from all sides of the room except its own.
bool is_clear(const Set& set, const SurfaceInteraction& surface) {
  if (set.clear == 0.0f) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const bool own = std::abs(surface.n_geometric[axis]) > 0.5f;
    if (!own && std::abs(surface.p_world[axis] - set.center[axis]) > set.half_side - set.clear) return false;
  }
  return true;
}

// Shadow rays to the light from the hits of random rays from the eye.
std::vector<Ray> shadow_rays(const Set& set, const Tracer& tracer, Terminator terminator, int rays) {
  Random random(71);
  std::vector<Ray> primary;
  for (int i = 0; i < rays; ++i) {
    const auto id = random.next() % static_cast<std::uint32_t>(set.mesh.triangles.size());
    const float u = random.between(0.01f, 0.98f), v = random.between(0.01f, 0.99f - u);
    const glm::vec3 a = corner(set.mesh, id, 0);
    const glm::vec3 in_triangle = u * (corner(set.mesh, id, 1) - a) + v * (corner(set.mesh, id, 2) - a);
    primary.push_back({set.eye, kInfinity, (a - set.eye) + in_triangle});
  }
  std::vector<Hit> hits(primary.size());
  tracer.closest_hits(primary, hits);
  std::vector<Ray> shadow;
  const shared::LightParams light = light_params(set.light);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].valid()) continue;
    const SurfaceInteraction surface =
        surface_at(tracer.mesh(), hits[i].triangle, primary[i].origin, primary[i].direction, tracer.offset());
    if (!is_clear(set, surface)) continue;
    const glm::vec2 square(random.between(0.0f, 1.0f), random.between(0.0f, 1.0f));
    if (const std::optional<Ray> ray = shadow_ray(light, surface, square, terminator)) shadow.push_back(*ray);
  }
  return shadow;
}

FailureCount count_shadows(const Set& set, const Method& method, int rays, bool expected) {
  const Tracer tracer = method.tracer(set.mesh);
  const std::vector<Ray> shadow = shadow_rays(set, tracer, method.terminator, rays);
  std::vector<std::uint8_t> blocked(shadow.size());
  FailureCount count;
  count.trials = shadow.size();
  {
    const Timed timed(count);
    tracer.occluded(shadow, blocked);
  }
  for (const std::uint8_t b : blocked) count.failures += (b != 0) == expected ? 0 : 1;
  return count;
}

Light light_at(const glm::vec3& position) {
  Light light;
  light.position = position;
  return light;
}

// Half of the rays to the light, half to one in the same direction that is as far away as the sun.
FailureCount near_and_far(Set set, const Method& method, int rays, bool expected) {
  FailureCount count = count_shadows(set, method, rays / 2, expected);
  set.light.kind = Light::Kind::directional;
  set.light.direction = -glm::normalize(set.light.position - set.center);
  if (set.light.radius > 0.0f) set.light.angle_deg = 60.0f;
  return count += count_shadows(set, method, rays / 2, expected);
}

Set lit_body(float size, const glm::vec3& center) {
  return {octahedron(center, size, 4), center + size * glm::vec3(2, 1, 3),
          light_at(center + size * glm::vec3(4, 5, 2)), center};
}

// A room seen from inside, with the light outside: every shadow ray must be blocked. Points are not tested
// where floats are so far apart that points beside a corner and behind the next wall are the same.
Set dark_room(float size, const glm::vec3& center) {
  const float spacing = 0x1p-23f * glm::length(center);
  return {box(center - glm::vec3(size), center + glm::vec3(size), 4),
          center + size * glm::vec3(0.25f, 0.125f, -0.25f),
          light_at(center + size * glm::vec3(0.5f, 0.25f, 4.0f)),
          center,
          size,
          2.0f * spacing};
}

// Every point of a convex body sees all of a light above its horizon, wherever the light is.
Set with_ball(Set set, const glm::vec3& center, float radius) {
  set.light.position = center;
  set.light.radius = radius;
  return set;
}
Set lit_by_ball(float size, const glm::vec3& center) {
  return with_ball(lit_body(size, center), center + size * glm::vec3(4, 5, 2), 2.0f * size);
}
Set touched_by_ball(float size, const glm::vec3& center) {
  return with_ball(lit_body(size, center), center + size * glm::vec3(0, 2, 0), size);
}
Set within_ball(float size, const glm::vec3& center) {
  return with_ball(lit_body(size, center), center + size * glm::vec3(1, 0, 0), 8.0f * size);
}
// The light's sphere surrounds the closed room and shines on it from all sides.
Set room_within_ball(float size, const glm::vec3& center) {
  return with_ball(dark_room(size, center), center + size * glm::vec3(0.5f, 0.25f, 0.0f), 8.0f * size);
}
Set room_beside_ball(float size, const glm::vec3& center) {
  return with_ball(dark_room(size, center), center + size * glm::vec3(0.5f, 0.25f, 4.0f), 2.0f * size);
}

using MakeSet = Set (*)(float size, const glm::vec3& center);

template <MakeSet make, bool expected>
FailureCount scaled(const Method& method, int rays) {
  FailureCount count;
  for (const float s : kScales) count += near_and_far(make(s, glm::vec3(0.0f)), method, rays / 5, expected);
  return count;
}

template <MakeSet make, bool expected>
FailureCount moved(const Method& method, int rays) {
  FailureCount count;
  for (const float s : kScales)
    for (const float m : kMoves)
      count += near_and_far(make(s, s * m * glm::vec3(1, -1, 1)), method, rays / 10, expected);
  return count;
}

// Under a node that mirrors, flattens, shrinks or enlarges: convex bodies stay convex, and closed rooms
// closed.
glm::mat4 scaling(float x, float y, float z) {
  return glm::mat4(glm::mat3(x, 0, 0, 0, y, 0, 0, 0, z));
}
const std::array kNodes{scaling(-1, 1, 1), scaling(-0x1p-20f, -0x1p-20f, -0x1p-20f),
                        scaling(0x1p-20f, -0x1p-20f, 0x1p-20f), scaling(1, -0x1p-5f, 1),
                        scaling(-0x1p20f, 0x1p20f, 0x1p20f)};

Set through_node(Set set, const glm::mat4& world_from_node) {
  Scene scene(std::move(set.mesh));
  const Mesh& mesh = *scene.mesh;
  NodeTree tree;
  tree.nodes.push_back({"", -1, glm::mat4(1.0f), 0, static_cast<std::uint32_t>(mesh.positions.size()), 0,
                        static_cast<std::uint32_t>(mesh.triangles.size())});
  RestPose rest;
  rest.positions = mesh.positions;
  rest.normals = mesh.normals;
  tree.rest = std::make_shared<const RestPose>(std::move(rest));
  scene.nodes = std::make_shared<const NodeTree>(std::move(tree));
  set.mesh = *posed(scene, std::array{NodeTransform{0, world_from_node}}).value().mesh;
  for (glm::vec3* const point : {&set.eye, &set.light.position, &set.center})
    *point = glm::vec3(world_from_node * glm::vec4(*point, 1.0f));
  return set;
}

template <MakeSet make, bool expected>
FailureCount by_nodes(const Method& method, int rays) {
  FailureCount count;
  for (const glm::mat4& node : kNodes)
    count += near_and_far(through_node(make(1.0f, glm::vec3(0.0f)), node), method, rays / 5, expected);
  return count;
}

// A tile in the hole of a floor a million times its size, all in one plane.
FailureCount beside_one_far_larger(const Method& method, int rays) {
  constexpr float kFar = 1e6f;
  MeshData mesh;
  const std::array<glm::vec3, 4> inner{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}};
  const std::array<glm::vec3, 4> outer{
      {{-kFar, 0, -kFar}, {kFar, 0, -kFar}, {kFar, 0, kFar}, {-kFar, 0, kFar}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    add(mesh, inner[i], outer[i], outer[j]);
    add(mesh, inner[i], outer[j], inner[j]);
  }
  add(mesh, inner[0], inner[2], inner[1]);
  add(mesh, inner[0], inner[3], inner[2]);
  return count_shadows({mesh, {0.5f, 2.0f, 0.5f}, light_at({3.0f, 2.0f, 1.0f})}, method, rays, false);
}

// A panel in the plane of a floor, and one that stands on the floor on its edge.
FailureCount grazing_panel(const Method& method, int rays) {
  FailureCount count;
  const MeshData body = octahedron(glm::vec3(0.0f), 1.0f, 4);
  for (const glm::vec3& up : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, 1, 1))}) {
    Light panel = light_at(up * 1.0f / std::max({up.x, up.y, up.z}));
    panel.kind = Light::Kind::rectangle;
    panel.edge_u = glm::normalize(glm::cross(up, glm::vec3(0.3f, 0.2f, 0.9f)));
    panel.edge_v = glm::cross(up, panel.edge_u);
    panel.direction = -up;
    count += count_shadows({body, {2, 1, 3}, panel}, method, rays / 2, false);
  }
  return count;
}

// A sphere of radius 0 and a disc of diameter 0 are a point and a direction: the same light, the same ray.
FailureCount no_radius(const Method& /*method*/, int rays) {
  FailureCount count;
  Random random(73);
  for (int i = 0; i < rays; ++i) {
    Light light = light_at(random_point(random, 5.0f));
    if (i % 2 == 1) light.kind = Light::Kind::directional, light.direction = glm::normalize(light.position);
    const shared::LightParams params = light_params(light);
    const glm::vec3 p = random_point(random, 5.0f);
    const shared::Incident hard = shared::incident_light(params, params.position, p);
    const glm::vec2 square(random.between(0.0f, 1.0f), random.between(0.0f, 1.0f));
    const shared::Incident sampled = shared::sampled_light(params, p, square);
    ++count.trials;
    count.failures += hard.to_light == sampled.to_light && hard.radiance == sampled.radiance &&
                              hard.target == sampled.target
                          ? 0
                          : 1;
  }
  return count;
}

MeshData coarse_ball() {
  return ball(glm::vec3(0.0f), 1.0f, 12);
}

// A light that grazes a smooth ball of few triangles: points that face it are lit, because the ball is
// convex.
FailureCount grazing_light(const Method& method, int rays) {
  FailureCount count;
  for (const float height : {0.0f, 0.5f, 2.0f})
    count +=
        count_shadows({coarse_ball(), {0, 0, 6}, light_at({10.0f, height, 0.5f})}, method, rays / 3, false);
  return count;
}

constexpr std::array kShadowCases{
    StressCase{"scaled by 1e-6 to 1e6: acne", "lit points in shadow", scaled<lit_body, false>},
    StressCase{"moved by 1e6 sizes: acne", "lit points in shadow", moved<lit_body, false>},
    StressCase{"scaled, closed room", "light leaks", scaled<dark_room, true>},
    StressCase{"moved, closed room", "light leaks", moved<dark_room, true>},
    StressCase{"nodes that mirror and scale: acne", "lit points in shadow", by_nodes<lit_body, false>},
    StressCase{"nodes that mirror and scale: room", "light leaks", by_nodes<dark_room, true>},
    StressCase{"beside one 1e6 times larger", "lit points in shadow", beside_one_far_larger},
    StressCase{"ball of light: acne", "lit points in shadow", scaled<lit_by_ball, false>},
    StressCase{"ball of light that touches: acne", "lit points in shadow", scaled<touched_by_ball, false>},
    StressCase{"ball of light around the scene: acne", "lit points in shadow", scaled<within_ball, false>},
    StressCase{"ball of light around a closed room", "light leaks", scaled<room_within_ball, true>},
    StressCase{"ball of light beside a closed room", "light leaks", scaled<room_beside_ball, true>},
    StressCase{"panel in a facet's plane", "lit points in shadow", grazing_panel},
    StressCase{"ball of light of radius 0", "other rays than its centre's", no_radius},
    StressCase{"low-poly ball, grazing light", "lit points in shadow", grazing_light},
};

}  // namespace

std::span<const StressCase> shadow_cases() {
  return kShadowCases;
}

}  // namespace pinocchio::stability
