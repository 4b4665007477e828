#include "core/trace/view/tile_frustum.h"

#include <algorithm>
#include <cmath>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// A share of the greatest coordinate, far above the rounding of rays and of the walk.
constexpr double kMargin = 1e-6;

// Boxes that are looked at in each tree. A tile of rays that miss takes as long to trace as a hundred of
// them.
constexpr int kMostBoxes = 40;

double greatest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

class Search {
 public:
  explicit Search(const TileFrustum& frustum) : frustum_(frustum) {}

  // False only if no ray can hit a triangle of the tree, or trees.
  [[nodiscard]] bool reaches(const BspTree& tree) {
    left_ = kMostBoxes;
    return reaches(tree, 0, tree.bounds);
  }
  [[nodiscard]] bool reaches(const std::vector<TopNode>& top) {
    left_ = kMostBoxes;
    return !top.empty() && reaches(top, 0);
  }

 private:
  bool reaches(const BspTree& tree, std::uint32_t index, const Bounds& box) {
    const BspNode& node = tree.nodes[index];
    if (node.is_leaf() && node.reference_count() == 0) return false;
    if (left_-- == 0) return true;
    if (frustum_.misses(box)) return false;
    if (node.is_leaf()) return true;
    Bounds below = box, above = box;
    below.hi[node.axis()] = above.lo[node.axis()] = node.split();
    return reaches(tree, node.first_child(), below) || reaches(tree, node.first_child() + 1, above);
  }

  bool reaches(const std::vector<TopNode>& top, std::uint32_t index) {
    const TopNode& node = top[index];
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (left_-- == 0) return true;
      if (frustum_.misses(node.box(i))) continue;
      if ((node.below[i] & TopNode::kNode) == 0 || reaches(top, node.below[i] & ~TopNode::kNode)) return true;
    }
    return false;
  }

  const TileFrustum& frustum_;
  int left_ = 0;
};

}  // namespace

TileFrustum::TileFrustum(const shared::ViewParams& view, const PixelBox& tile) {
  const glm::dvec3 eye(view.eye), corner(view.corner), step_x(view.step_x), step_y(view.step_y);
  const glm::dvec2 lo = glm::dvec2(view.first) + glm::dvec2(tile.lo) - 1.0,
                   hi = glm::dvec2(view.first) + glm::dvec2(tile.hi);
  // Directions from the eye, or origins of parallel rays less the first one's.
  const glm::dvec3 base = view.parallel ? glm::dvec3(0.0) : corner;
  const auto at = [&](double x, double y) { return base + x * step_x + y * step_y; };
  const std::array<glm::dvec3, 4> corners{at(lo.x, lo.y), at(hi.x, lo.y), at(hi.x, hi.y), at(lo.x, hi.y)};
  const glm::dvec3 middle = at(0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y));
  reach_ = greatest(eye);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 4];
    Plane& plane = planes_[i];
    plane.inward = view.parallel ? glm::cross(b - a, corner) : glm::cross(a, b);
    if (glm::dot(plane.inward, view.parallel ? middle - a : middle) < 0.0) plane.inward = -plane.inward;
    plane.offset = glm::dot(plane.inward, view.parallel ? eye + a : eye);
    if (view.parallel) reach_ = std::max(reach_, greatest(eye + a));
  }
}

bool TileFrustum::misses(const Bounds& box) const {
  const glm::dvec3 lo(box.lo), hi(box.hi);
  const double margin = kMargin * std::max({reach_, greatest(lo), greatest(hi)});
  return std::ranges::any_of(planes_, [&](const Plane& plane) {
    double inmost = -plane.offset;
    for (int i = 0; i < 3; ++i)
      inmost +=
          std::max(plane.inward[i] * lo[i], plane.inward[i] * hi[i]) + std::abs(plane.inward[i]) * margin;
    return inmost < 0.0;
  });
}

bool misses(const TileFrustum& frustum, const SceneTrees& trees) {
  if (frustum.misses(trees.bounds)) return true;
  Search search(frustum);
  return !search.reaches(*trees.still) && !search.reaches(trees.top);
}

}  // namespace pinocchio
