#include "bench/rays/sides/ray_sets.h"

#include <map>
#include <random>
#include <utility>

#include "bench/rays/sides/drawing.h"

namespace pinocchio::bench {
namespace {

std::string name_of(int generation, bool shadow) {
  constexpr const char* kNames[] = {"visible points", "reflection", "second bounce"};
  const std::string name = generation < 3 ? kNames[generation] : "bounce " + std::to_string(generation);
  if (generation == 0) return shadow ? "shadow" : "primary";
  return shadow ? "shadow of " + name : name;
}

}  // namespace

std::vector<RaySet> frame_ray_sets(const Scene& scene, const Tracer& tracer, glm::ivec2 size) {
  std::map<std::pair<int, bool>, RaySet> sets;
  Workers one(1);
  Drawing({scene, tracer, one, first_view(scene, size)}, size).draw([&](const RayBatch& batch) {
    RaySet& set = sets[{batch.generation, batch.shadow}];
    set.query = batch.shadow ? Query::any : Query::closest;
    const RayColumns& c = batch.rays;
    for (std::size_t i = 0; i < batch.count; ++i)
      set.rays.push_back({{c.origin[0][i], c.origin[1][i], c.origin[2][i]},
                          c.reach,
                          {c.direction[0][i], c.direction[1][i], c.direction[2][i]}});
  });
  std::vector<RaySet> named;
  for (auto& [key, set] : sets) {
    set.name = name_of(key.first, key.second);
    named.push_back(std::move(set));
  }
  return named;
}

RaySet random_rays(const Mesh& mesh, std::size_t count) {
  Bounds box;
  for (const glm::vec3& p : mesh.positions) box.add(p);
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> part;
  RaySet set{"random", Query::closest, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 away = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    const glm::vec3 from = box.center() + 1.5f * box.diagonal() * away;
    const glm::vec3 to = box.lo + glm::vec3(part(random), part(random), part(random)) * box.extent();
    set.rays.push_back({from, kInfinity, to - from});
  }
  return set;
}

}  // namespace pinocchio::bench
