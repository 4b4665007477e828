#include "hybrid/settings/scene_stats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/light_reach.h"
#include "pinocchio/studio.h"

namespace pinocchio {
namespace {

double area_of(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

// Finds how often light can be mirrored, from all mirrors.
class MirrorWalk {
 public:
  // moves: mirrors in one plane may leave it later
  MirrorWalk(const Mesh& mesh, const Bounds& bounds, bool moves)
      : mesh_(mesh), slack_(1e-7 * static_cast<double>(bounds.diagonal())), flat_(!moves) {}

  void add(const glm::uvec3& t, const Material& m, bool see_through) {
    const bool unlimited = see_through || m.fresnel || m.is_microfacet();
    const float most = std::max({m.reflectance.x, m.reflectance.y, m.reflectance.z});
    most_ = std::max(most_, unlimited ? 1.0 : static_cast<double>(most));
    if (flat_) flat_ = !see_through && in_plane(t);
  }

  [[nodiscard]] int useful_depth() const {
    if (flat_) return 1;  // a ray from a plane does not meet it again
    if (most_ >= 1.0) return kMostBounces;
    const double bounces = std::log(static_cast<double>(kThroughputCutoff)) / std::log(most_);
    return std::clamp(static_cast<int>(bounces), 1, kMostBounces);
  }

 private:
  // Whether the triangle lies in the plane of the first triangle with an area.
  bool in_plane(const glm::uvec3& t) {
    const glm::dvec3 a(mesh_.positions[t.x]), b(mesh_.positions[t.y]), c(mesh_.positions[t.z]);
    if (n_ == glm::dvec3(0.0)) {
      const glm::dvec3 n = glm::cross(b - a, c - a);
      if (glm::length(n) == 0.0) return true;
      n_ = glm::normalize(n);
      d_ = glm::dot(n_, a);
    }
    const auto off = [&](const glm::dvec3& p) { return std::abs(glm::dot(n_, p) - d_); };
    return std::max({off(a), off(b), off(c)}) <= slack_;
  }

  const Mesh& mesh_;
  double slack_;
  double most_ = 0.0;
  bool flat_;
  glm::dvec3 n_{0.0};
  double d_ = 0.0;
};

void note(const MaterialMaps& maps, SceneStats& stats) {
  stats.textures = stats.textures || std::ranges::any_of(maps.uses(), &TextureUse::used);
  stats.vertex_colors = stats.vertex_colors || maps.vertex_colors;
  stats.holes = stats.holes || maps.has_holes();
  stats.blends = stats.blends || maps.blends();
}

// Whether hits on the material start mirrored rays. sampled: directions of glossy lobes are.
bool mirrors(const Material& material, bool sampled) {
  return material.reflects() || (sampled && material.is_microfacet());
}

bool sees_through(const Mesh& mesh, const Material& material) {
  return material.transmits() ||
         (material.maps >= 0 && mesh.maps[static_cast<std::size_t>(material.maps)].blends());
}

// The materials of some triangle.
std::vector<bool> used_materials(const Mesh& mesh) {
  std::vector<bool> used(mesh.materials.size(), false);
  std::uint32_t last = 0xffffffffu;  // neighbours mostly have the same material
  for (const std::uint32_t material : mesh.triangle_materials)
    if (material != last) used[last = material] = true;
  return used;
}

}  // namespace

SceneStats analyze(const Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  SceneStats stats;
  stats.triangles = mesh.triangles.size();
  stats.bounds = mesh.bounds();
  const bool sampled = takes_samples(scene);
  recount_lights(scene, stats);
  const std::vector<bool> used = used_materials(mesh);
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (!used[m]) continue;
    const Material& material = mesh.materials[m];
    if (material.maps >= 0) note(mesh.maps[static_cast<std::size_t>(material.maps)], stats);
    stats.mirrors = stats.mirrors || mirrors(material, sampled) || sees_through(mesh, material);
  }
  if (!stats.mirrors) {
    stats.useful_depth = 0;
    return stats;
  }
  double all = 0.0, mirroring = 0.0, transmitting = 0.0;
  MirrorWalk walk(mesh, stats.bounds, scene.animation != nullptr);
  // A triangle without an area may have one at another time.
  const double least_area = scene.animation ? std::numeric_limits<double>::min() : 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Material& material = mesh.materials[mesh.triangle_materials[i]];
    const double area = std::max(area_of(mesh, mesh.triangles[i]), least_area);
    all += area;
    const bool see_through = sees_through(mesh, material);
    if (!see_through && !mirrors(material, sampled)) continue;
    mirroring += area;
    if (see_through) transmitting += area;
    walk.add(mesh.triangles[i], material, see_through);
  }
  if (all > 0.0) stats.mirror_share = mirroring / all;
  if (all > 0.0) stats.transmitting_share = transmitting / all;
  stats.useful_depth = walk.useful_depth();
  return stats;
}

void recount_lights(const Scene& scene, SceneStats& stats) {
  stats.lights = static_cast<int>(scene.lights.size());
  stats.casting_lights = stats.idle_lights = 0;
  stats.environment = scene.environment != nullptr;
  stats.studio = has_studio_light(scene);
  for (const Light& light : scene.lights) {
    if (!may_reach(light, scene)) {
      ++stats.idle_lights;
    } else if (light.casts_shadow) {
      ++stats.casting_lights;
    }
  }
}

}  // namespace pinocchio
