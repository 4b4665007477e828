#include "core/bsp/moving/kept_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bsp/build/build.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The share of a tree's size by which vertices may have moved among themselves. Rounding is far below; beyond
// it, the error would let rays visit much of the tree.
constexpr double kMostError = 1e-3;

// Least determinant of a matrix whose greatest entry is 1: below it, a tree has nearly lost a dimension.
constexpr double kFlat = 1e-6;

using Quad [[gnu::vector_size(16)]] = float;
Quad quad(const glm::vec3& v) {
  return Quad{v.x, v.y, v.z, 0.0f};
}

bool is_flat(const glm::dmat3& m) {
  double most = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(m[i][j]));
  return !(std::abs(glm::determinant(m)) > kFlat * most * most * most);  // also NaN
}

}  // namespace

KeptTree build_kept(const Scene& scene, const std::vector<int>& nodes, const glm::mat4& world_from_root,
                    const BuildOptions& options) {
  const Mesh& mesh = *scene.mesh;
  KeptTree kept;
  std::vector<std::uint32_t> ids;
  for (const int n : nodes) {
    const Node& node = scene.nodes->nodes[n];
    for (std::uint32_t t = 0; t < node.triangles; ++t) ids.push_back(node.first_triangle + t);
    const auto first = mesh.positions.begin() + node.first_vertex;
    kept.vertices.insert(kept.vertices.end(), first, first + node.vertices);
  }
  BuildMesh part(mesh);
  part.ids = ids;
  part.keeps_flat = true;
  BuildOptions quiet = options;
  quiet.progress = nullptr;
  kept.tree = std::make_shared<const BspTree>(build_nodes(part, quiet, kept.order));
  kept.world_from_root = glm::dmat4(world_from_root);
  return kept;
}

std::optional<Motion> motion_since(const KeptTree& kept, const Scene& scene, const std::vector<int>& nodes,
                                   const glm::mat4& world_from_root) {
  std::vector<std::span<const glm::vec3>> pieces;
  for (const int n : nodes)
    pieces.push_back(std::span(scene.mesh->positions)
                         .subspan(scene.nodes->nodes[n].first_vertex, scene.nodes->nodes[n].vertices));
  return motion_since(kept, pieces, world_from_root);
}

std::optional<Motion> motion_since(const KeptTree& kept, std::span<const std::span<const glm::vec3>> pieces,
                                   const glm::mat4& world_from_root) {
  const glm::dmat4 now(world_from_root);
  if (is_flat(glm::dmat3(now)) || is_flat(glm::dmat3(kept.world_from_root))) return std::nullopt;
  Motion motion{kept.world_from_root * glm::inverse(now), glm::dvec3(0.0)};
  if (is_flat(glm::dmat3(motion.tree_from_world))) return std::nullopt;
  const glm::mat4 m(motion.tree_from_world);
  const Quad x = quad(glm::vec3(m[0])), y = quad(glm::vec3(m[1])), z = quad(glm::vec3(m[2])),
             shift = quad(glm::vec3(m[3]));
  Quad most{}, sum{};
  const glm::vec3* built = kept.vertices.data();
  for (const std::span<const glm::vec3> piece : pieces)
    for (const glm::vec3& p : piece) {
      const Quad off = x * p.x + y * p.y + z * p.z + shift - quad(*built);
      const Quad size = off < 0.0f ? -off : off;
      most = size > most ? size : most;
      sum += size;  // NaN stays
      ++built;
    }
  motion.error = {most[0], most[1], most[2]};
  const double limit = kMostError * as_double(kept.tree->exact_bounds.diagonal());
  if (!std::isfinite(sum[0] + sum[1] + sum[2]) || std::max({most[0], most[1], most[2]}) > limit)
    return std::nullopt;
  return motion;
}

void Motion::describe(const Bounds& bounds, MovingTree& tree) const {
  const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(bounds.lo)), glm::abs(glm::dvec3(bounds.hi)));
  for (int i = 0; i < 3; ++i) {
    double size = std::abs(tree_from_world[3][i]);
    for (int j = 0; j < 4; ++j) {
      tree.tree_from_world[i][j] = as_float(tree_from_world[j][i]);
      if (j < 3) size += std::abs(tree_from_world[j][i]) * reach[j];
    }
    // kPerOrigin also holds the rounding of `error`'s sums, an eighth of it; and a plane's error must not
    // vanish.
    const double margin = as_double(MovingTree::kPerOrigin) * size + 1.001 * error[i];
    tree.margin[i] = std::max(as_float(1.001 * margin), std::numeric_limits<float>::min());
  }
}

}  // namespace pinocchio
