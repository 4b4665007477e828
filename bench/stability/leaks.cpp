// Rays from inside closed meshes, at edges and vertices.
#include <array>

#include "bench/stability/count.h"
#include "bench/stability/shapes.h"
#include "core/reference/reference_tree.h"

namespace pinocchio::stability {
namespace {

FailureCount of_ball(const Method& method, int rays, const glm::vec3& center, float radius, int around) {
  const MeshData mesh = ball(center, radius, around, 0.3f);
  return count_misses(method.tracer(mesh), rays_at_edges(mesh, center, 0.3f * radius, rays));
}

// Rays from a rough ball's centre to random points: the cost of other cases is compared with this one.
FailureCount usual_rays(const Method& method, int rays) {
  const MeshData mesh = ball(glm::vec3(0.0f), 1.0f, 32, 0.3f);
  Random random(42);
  std::vector<Ray> some;
  for (int i = 0; i < rays; ++i) {
    const glm::vec3 origin = random_point(random, 0.3f);
    some.push_back({origin, kInfinity, random_point(random, 1.0f) - origin});
  }
  return count_misses(method.tracer(mesh), some);
}

constexpr int kMoreAtEdges = 5;

FailureCount jagged_ball(const Method& method, int rays) {
  const int half = kMoreAtEdges * rays / 2;
  FailureCount count = of_ball(method, half, glm::vec3(0.0f), 1.0f, 32);
  return count += of_ball(method, half, glm::vec3(0.0f), 1.0f, 16);
}

FailureCount far_from_origin(const Method& method, int rays) {
  const int half = kMoreAtEdges * rays / 2;
  FailureCount count = of_ball(method, half, {1000.0f, -300.0f, 20.0f}, 1.0f, 32);
  return count += of_ball(method, half, {148376.0f, 1234.0f, -223423.0f}, 100.0f, 100);
}

FailureCount needles(const Method& method, int rays) {
  const MeshData mesh = room_of_strips(256);
  return count_misses(method.tracer(mesh), rays_at_edges(mesh, {0.0f, 0.0f, -0.5f}, 0.4f, rays));
}

// Some rays really pass through: a failure is a ray that the reference hits and the method misses.
FailureCount t_junctions(const Method& method, int rays) {
  const MeshData mesh = ball_with_t_junctions(32);
  const Tracer tracer = method.tracer(mesh);
  const ReferenceTree reference(tracer.mesh());
  const std::vector<Ray> at_edges = rays_at_edges(mesh, {0.1f, 0.2f, 0.3f}, 0.3f, rays);
  FailureCount count;
  count.trials = at_edges.size();
  const std::vector<Hit> hits = trace(tracer, at_edges, count);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool gap =
        !reference.closest_hit({glm::dvec3(at_edges[i].origin), glm::dvec3(at_edges[i].direction)}).valid();
    if (gap) ++count.excused;
    if (!gap && !hits[i].valid()) ++count.failures;
  }
  return count;
}

constexpr std::array kLeakCases{
    StressCase{"usual rays", "leaks", usual_rays},
    StressCase{"edges and vertices", "leaks", jagged_ball},
    StressCase{"edges far from the origin", "leaks", far_from_origin},
    StressCase{"needles, aspect 1e6", "leaks", needles},
    StressCase{"T-junctions", "leaks that the reference does not have", t_junctions},
};

}  // namespace

std::span<const StressCase> leak_cases() {
  return kLeakCases;
}

}  // namespace pinocchio::stability
