#include "core/reference/reference_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/math/components.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kStackSize = 64;  // halving 2^32 triangles takes 32 levels, with one waiting node each

// Boxes are widened by this share of the coordinates: many times the error of subtracting the origin and
// shearing a corner in double, so that no box of a hit triangle is missed.
constexpr double kBoxError = 32.0 * 0x1p-53;

bool all_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The t at which the ray enters the box, widened by `margin`; infinity if it does not enter before t_max.
double entry(const ReferenceRay& ray, const Bounds& box, double margin, double t_max) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double t_in = 0.0, t_out = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = box.lo[axis] - margin - ray.origin[axis];
    const double hi = box.hi[axis] + margin - ray.origin[axis];
    if (ray.direction[axis] == 0.0) {
      if (lo > 0.0 || hi < 0.0) return kNever;
      continue;
    }
    const double t_lo = lo / ray.direction[axis], t_hi = hi / ray.direction[axis];
    t_in = std::max(t_in, std::min(t_lo, t_hi) * (1.0 - kBoxError));
    t_out = std::min(t_out, std::max(t_lo, t_hi) * (1.0 + kBoxError));
  }
  return t_in <= t_out ? t_in : kNever;
}

}  // namespace

ReferenceTree::ReferenceTree(const Mesh& mesh, const Progress* progress)
    : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(progress);
}

void ReferenceTree::build(const Progress* progress) {
  nodes_.reserve(2 * order_.size());
  nodes_.push_back({{}, 0, as_uint32(order_.size()), 0});
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    throw_if_cancelled(progress);
    nodes_[i].box = bounds_of(nodes_[i]);
    if (nodes_[i].count <= kLeafSize) continue;
    const Node node = nodes_[i];
    halve(node);
    const std::uint32_t half = node.count / 2;
    nodes_[i].children = nodes_.size();
    nodes_.push_back({{}, node.first, half, 0});
    nodes_.push_back({{}, node.first + half, node.count - half, 0});
  }
  const Bounds& all = nodes_.front().box;
  reach_ = std::max(largest_component(glm::dvec3(all.lo)), largest_component(glm::dvec3(all.hi)));
}

Bounds ReferenceTree::bounds_of(const Node& node) const {
  Bounds box;
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
    for (int corner = 0; corner < 3; ++corner) box.add(mesh_.positions[mesh_.triangles[order_[k]][corner]]);
  return box;
}

// Sorts the node's triangles into a half with lower and a half with higher centroids.
void ReferenceTree::halve(const Node& node) {
  const auto centroid_times_3 = [&](std::uint32_t id) {
    const glm::uvec3& t = mesh_.triangles[id];
    return glm::dvec3(mesh_.positions[t.x]) + glm::dvec3(mesh_.positions[t.y]) +
           glm::dvec3(mesh_.positions[t.z]);
  };
  const auto begin = order_.begin() + node.first, end = begin + node.count;
  glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (auto id = begin; id != end; ++id) {
    lo = glm::min(lo, centroid_times_3(*id));
    hi = glm::max(hi, centroid_times_3(*id));
  }
  const glm::dvec3 extent = hi - lo;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::nth_element(begin, begin + node.count / 2, end, [&](std::uint32_t a, std::uint32_t b) {
    return centroid_times_3(a)[axis] < centroid_times_3(b)[axis];
  });
}

ReferenceHit ReferenceTree::closest_hit(const ReferenceRay& ray, const IsPassed& is_passed) const {
  ReferenceHit hit;
  if (nodes_.empty() || !all_finite(ray.origin) || !all_finite(ray.direction) ||
      ray.direction == glm::dvec3(0.0))
    return hit;
  const ReferenceTest test(ray);
  const double margin = kBoxError * (reach_ + largest_component(ray.origin));
  std::array<std::uint32_t, kStackSize> stack{0};
  for (std::size_t waiting = 1; waiting > 0;) {
    const Node& node = nodes_[stack[--waiting]];
    // A box that begins at hit.t is visited too: it may have a lower id at the same t.
    if (std::isinf(entry(ray, node.box, margin, std::min(ray.t_max, hit.t)))) continue;
    if (node.children != 0) {
      const double left = entry(ray, nodes_[node.children].box, margin, hit.t);
      const double right = entry(ray, nodes_[node.children + 1].box, margin, hit.t);
      const std::uint32_t nearer = left <= right ? 0 : 1;
      stack[waiting++] = node.children + 1 - nearer;
      stack[waiting++] = node.children + nearer;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (is_passed && is_passed(order_[k])) continue;
      const glm::uvec3& t = mesh_.triangles[order_[k]];
      test.meet(order_[k], mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z], hit);
    }
  }
  return hit;
}

}  // namespace pinocchio
