#include "hybrid/settings/scene_stats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/scene/light_reach.h"
#include "core/scene/pose/mesh_pose.h"
#include "pinocchio/conversion.h"
#include "pinocchio/studio.h"

namespace pinocchio {
namespace {

double area_of(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

// Whether the triangles all lie in the plane of the first that has an area: a ray from it does not meet it
// again.
bool lie_in_one_plane(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  const double slack = 1e-7 * as_double(mesh.bounds().diagonal());
  glm::dvec3 n(0.0);
  double d = 0.0;
  for (const std::uint32_t triangle : triangles) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    if (n == glm::dvec3(0.0)) {
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      if (glm::length(normal) == 0.0) continue;
      n = glm::normalize(normal);
      d = glm::dot(n, a);
    }
    const auto off = [&](const glm::dvec3& p) { return std::abs(glm::dot(n, p) - d); };
    if (!(std::max({off(a), off(b), off(c)}) <= slack)) return false;
  }
  return true;
}

// The most light that a mirror of the material returns.
double most_mirrored(const Material& m, bool see_through) {
  if (see_through || m.fresnel || m.is_microfacet()) return 1.0;
  return as_double(std::max({m.reflectance.x, m.reflectance.y, m.reflectance.z}));
}

int depth_of_mirrors(double most) {
  if (most >= 1.0) return kMostBounces;
  const double bounces = std::log(as_double(kThroughputCutoff)) / std::log(most);
  return std::clamp(as_int(bounces), 1, kMostBounces);
}

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
  return material.transmits() || (material.maps >= 0 && mesh.maps[as_size(material.maps)].blends());
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
  return PoseStats().of(scene);
}

SceneStats PoseStats::of(const Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  const std::shared_ptr<const MeshPose>& pose = mesh.pose();
  const bool sampled = takes_samples(scene), moves = scene.animation != nullptr;
  const bool known = pose && pose_ && pose_->is_of_same_mesh(*pose) && sampled == sampled_ && moves == moves_;
  if (!known) {
    sampled_ = sampled;
    moves_ = moves;
    look_at_materials(mesh);
  }
  stats_.bounds = mesh.bounds();
  recount_lights(scene, stats_);
  if (stats_.mirrors) {
    add_areas(mesh, known ? pose_.get() : nullptr);
    stats_.useful_depth =
        !moves && !sees_through_ && lie_in_one_plane(mesh, mirroring_) ? 1 : depth_of_mirrors(most_);
  }
  pose_ = pose;
  return stats_;
}

// What all poses have in common.
void PoseStats::look_at_materials(const Mesh& mesh) {
  stats_ = {};
  stats_.triangles = mesh.triangles.size();
  stats_.useful_depth = 0;
  most_ = 0.0;
  sees_through_ = false;
  mirroring_.clear();
  kinds_.assign(mesh.materials.size(), Kind::plain);
  const std::vector<bool> used = used_materials(mesh);
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (!used[m]) continue;
    const Material& material = mesh.materials[m];
    stats_.glossy = stats_.glossy || material.is_glossy();
    stats_.microfacets = stats_.microfacets || material.is_microfacet();
    if (material.maps >= 0) note(mesh.maps[as_size(material.maps)], stats_);
    stats_.glass = stats_.glass || material.transmits();
    const bool see_through = sees_through(mesh, material);
    if (!see_through && !mirrors(material, sampled_)) continue;
    kinds_[m] = see_through ? Kind::see_through : Kind::mirror;
    stats_.mirrors = true;
    sees_through_ = sees_through_ || see_through;
    most_ = std::max(most_, most_mirrored(material, see_through));
  }
  if (!stats_.mirrors) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (kinds_[mesh.triangle_materials[i]] != Kind::plain) mirroring_.push_back(as_uint32(i));
}

PoseStats::Areas PoseStats::areas_of(const Mesh& mesh, std::size_t first, std::size_t last) const {
  // A triangle without an area may have one at another time.
  const double least_area = moves_ ? std::numeric_limits<double>::min() : 0.0;
  Areas sum;
  for (std::size_t i = first; i < last; ++i) {
    const Kind kind = kinds_[mesh.triangle_materials[i]];
    const double area = std::max(area_of(mesh, mesh.triangles[i]), least_area);
    sum.all += area;
    if (kind != Kind::plain) sum.mirroring += area;
    if (kind == Kind::see_through) sum.transmitting += area;
  }
  return sum;
}

// `before`: the pose of the areas that are known; null: none.
void PoseStats::add_areas(const Mesh& mesh, const MeshPose* before) {
  static const std::vector<NodePlace> kNoNodes;
  const std::vector<NodePlace>& nodes = mesh.pose() ? mesh.pose()->nodes : kNoNodes;
  if (!before) {
    nodes_.assign(nodes.size(), {});
    others_ = {};
    std::size_t next = 0;
    for (const NodePlace& node : nodes) {
      if (node.triangles == 0) continue;
      others_ += areas_of(mesh, next, node.first_triangle);
      next = std::size_t{node.first_triangle} + node.triangles;
    }
    others_ += areas_of(mesh, next, mesh.triangles.size());
  }
  Areas sum = others_;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const NodePlace& node = nodes[n];
    if (node.triangles > 0 && !(before && node.same_as(before->nodes[n])))
      nodes_[n] = areas_of(mesh, node.first_triangle, std::size_t{node.first_triangle} + node.triangles);
    sum += nodes_[n];
  }
  stats_.mirror_share = sum.all > 0.0 ? sum.mirroring / sum.all : 0.0;
  stats_.transmitting_share = sum.all > 0.0 ? sum.transmitting / sum.all : 0.0;
}

void recount_lights(const Scene& scene, SceneStats& stats) {
  stats.lights = as_int(scene.lights.size());
  stats.casting_lights = stats.idle_lights = 0;
  stats.environment = scene.environment != nullptr;
  stats.studio = has_studio_sky(scene);
  stats.sized_lights = std::ranges::any_of(scene.lights, &Light::has_size);
  for (const Light& light : scene.lights) {
    if (!may_reach(light, scene)) {
      ++stats.idle_lights;
    } else if (light.casts_shadow) {
      ++stats.casting_lights;
    }
  }
}

}  // namespace pinocchio
