#include "core/bsp/build.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <system_error>
#include <thread>
#include <utility>

#include "core/bsp/clip.h"
#include "core/bsp/split.h"

namespace pinocchio {
namespace {

using References = std::vector<BuildReference>;

// Wald and Havran 2006: 8 + 1.3 log2 n holds for triangle meshes of every size.
int default_depth(std::size_t triangles) {
  return static_cast<int>(8.0 + 1.3 * std::log2(static_cast<double>(triangles)));
}

// The median rules do not ask what a split gains: after this many above a node that sent most references to both
// sides, it is a leaf. Else thousands of triangles through one point double at every level.
constexpr int kMostWasted = 3;

// Fewer references than this are not worth a thread.
constexpr std::size_t kLeastForThread = 4096;

// A part of the tree on its own: its root is node 0, node 1 is padding, first_child and first_reference
// count from its own beginning.
struct Subtree {
  AlignedVector<BspNode> nodes = AlignedVector<BspNode>(2, BspNode::leaf(0, 0));
  AlignedVector<std::uint32_t> references;
  int depth = 0;
};

// Puts `part` behind what is in `to`, its root in node `index`: as if it had been built there.
void splice(const Subtree& part, Subtree& to, std::uint32_t index) {
  const auto nodes = static_cast<std::uint32_t>(to.nodes.size()) - 2;
  const auto references = static_cast<std::uint32_t>(to.references.size());
  const auto moved = [&](const BspNode& n) {
    return n.is_leaf() ? BspNode::leaf(n.first_reference() + references, n.reference_count())
                       : BspNode::inner(n.axis(), n.split(), n.first_child() + nodes);
  };
  to.nodes[index] = moved(part.nodes[0]);
  for (std::size_t i = 2; i < part.nodes.size(); ++i) to.nodes.push_back(moved(part.nodes[i]));
  to.references.insert(to.references.end(), part.references.begin(), part.references.end());
  to.depth = std::max(to.depth, part.depth);
}

class Builder {
 public:
  Builder(const Scene& scene, const BuildOptions& options, BspTree& tree)
      : scene_(scene), options_(options), tree_(tree) {
    const int threads =
        options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
    while ((1 << fork_depth_) < threads) ++fork_depth_;
    if (threads > 1) fork_depth_ += 2;  // halves are seldom equal: some more parts than threads
    const int wanted = options.max_depth > 0 ? options.max_depth : default_depth(scene.triangles.size());
    max_depth_ = std::clamp(wanted, 1, kMaxTreeDepth);
  }

  void build() {
    References all = all_references();
    for (const BuildReference& r : all) tree_.bounds.add(r.bounds);
    Subtree whole;
    build_node(whole, 0, std::move(all), tree_.bounds, 0, 0);
    whole.nodes.shrink_to_fit();
    whole.references.shrink_to_fit();
    tree_.nodes = std::move(whole.nodes);
    tree_.references = std::move(whole.references);
    tree_.depth = whole.depth;
  }

 private:
  // A triangle without area is met by no ray and stays out of the tree.
  [[nodiscard]] References all_references() const {
    References all;
    all.reserve(scene_.triangles.size());
    for (std::uint32_t i = 0; i < scene_.triangles.size(); ++i) {
      if (std::isnan(tree_.triangles[i].n_u)) continue;
      Bounds b;
      for (int k = 0; k < 3; ++k) b.add(corner(i, k));
      all.push_back({i, b});
    }
    return all;
  }

  [[nodiscard]] const glm::vec3& corner(std::uint32_t triangle, int k) const {
    return scene_.positions[scene_.triangles[triangle][k]];
  }

  void build_node(Subtree& to, std::uint32_t index, References references, const Bounds& box, int depth,
                  int wasted) const {
    to.depth = std::max(to.depth, depth);
    const std::optional<SplitPlane> plane = depth < max_depth_ ? choose(references, box) : std::nullopt;
    if (!plane) {
      make_leaf(to, index, references);
      return;
    }
    Bounds low_box = box, high_box = box;
    low_box.hi[plane->axis] = plane->position;
    high_box.lo[plane->axis] = plane->position;
    References low, high;
    partition(references, *plane, low_box, high_box, low, high);
    const bool wastes =
        options_.rule != SplitRule::sah && 2 * (low.size() + high.size()) > 3 * references.size();
    if (wastes) ++wasted;
    const bool told_apart = low.size() < references.size() || high.size() < references.size();
    if (!told_apart || wasted > kMostWasted) {
      make_leaf(to, index, references);
      return;
    }
    References().swap(references);  // the parent's are not needed while its children are built

    const auto children = static_cast<std::uint32_t>(to.nodes.size());
    to.nodes.resize(to.nodes.size() + 2, BspNode::leaf(0, 0));
    to.nodes[index] = BspNode::inner(plane->axis, plane->position, children);
    std::future<Subtree> other;
    if (depth < fork_depth_ && std::min(low.size(), high.size()) >= kLeastForThread)
      other = fork(high, high_box, depth + 1, wasted);
    build_node(to, children, std::move(low), low_box, depth + 1, wasted);
    if (other.valid())
      splice(other.get(), to, children + 1);
    else
      build_node(to, children + 1, std::move(high), high_box, depth + 1, wasted);
  }

  // Builds the node on a thread of its own; nothing, and `references` as they were, where none is to be had.
  [[nodiscard]] std::future<Subtree> fork(References& references, const Bounds& box, int depth,
                                          int wasted) const {
    const auto work = [this, &references, box, depth, wasted] {
      Subtree part;
      build_node(part, 0, std::move(references), box, depth, wasted);
      return part;
    };
    try {
      return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
      return {};
    }
  }

  [[nodiscard]] std::optional<SplitPlane> choose(const References& references, const Bounds& box) const {
    if (references.size() <= static_cast<std::size_t>(options_.leaf_size)) return std::nullopt;
    switch (options_.rule) {
      case SplitRule::spatial_median:
        return find_spatial_median(box);
      case SplitRule::object_median:
        return find_object_median(references, box);
      case SplitRule::sah:
        break;
    }
    const std::optional<SplitPlane> best = find_sah_split(references, box, options_);
    const float leaf_cost = options_.cost_intersection * static_cast<float>(references.size());
    return best && best->cost < leaf_cost ? best : std::nullopt;
  }

  void partition(const References& references, const SplitPlane& plane, const Bounds& low_box,
                 const Bounds& high_box, References& low, References& high) const {
    for (const BuildReference& r : references) {
      const float lo = r.bounds.lo[plane.axis], hi = r.bounds.hi[plane.axis];
      if (lo == plane.position && hi == plane.position) {
        (plane.flat_goes_low ? low : high).push_back(r);
      } else if (hi <= plane.position) {
        low.push_back(r);
      } else if (lo >= plane.position) {
        high.push_back(r);
      } else {
        add_clipped(r.triangle, low_box, low);
        add_clipped(r.triangle, high_box, high);
      }
    }
  }

  void add_clipped(std::uint32_t triangle, const Bounds& box, References& to) const {
    const Bounds b = clipped_bounds(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), box);
    if (!b.empty()) to.push_back({triangle, b});
  }

  static void make_leaf(Subtree& to, std::uint32_t index, const References& references) {
    const auto first = static_cast<std::uint32_t>(to.references.size());
    to.nodes[index] = BspNode::leaf(first, static_cast<std::uint32_t>(references.size()));
    for (const BuildReference& r : references) to.references.push_back(r.triangle);
  }

  const Scene& scene_;
  const BuildOptions& options_;
  BspTree& tree_;
  int max_depth_;
  int fork_depth_ = 0;  // nodes above this depth may be shared out to two threads
};

// A ray computes its entry into the box with three roundings; flat scenes need some thickness, too.
void widen(Bounds& bounds) {
  if (bounds.empty()) return;
  const glm::vec3 largest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  const float margin = 1e-6f * std::max({largest.x, largest.y, largest.z, 1e-30f});
  bounds.lo -= margin;
  bounds.hi += margin;
}

AlignedVector<CornerTriangle> corner_triangles(const Scene& scene) {
  AlignedVector<CornerTriangle> result(scene.triangles.size());
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    result[i].id = i;
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        result[i].corners[corner][axis] = scene.positions[scene.triangles[i][corner]][axis];
  }
  return result;
}

}  // namespace

std::optional<SplitRule> parse_split_rule(std::string_view name) {
  if (name == "sah") return SplitRule::sah;
  if (name == "spatial-median") return SplitRule::spatial_median;
  if (name == "object-median") return SplitRule::object_median;
  return std::nullopt;
}

BspTree build_tree(const Scene& scene, const BuildOptions& options) {
  BspTree tree;
  tree.triangles.reserve(scene.triangles.size());
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const glm::uvec3& t = scene.triangles[i];
    tree.triangles.push_back(
        ProjectedTriangle::from(scene.positions[t.x], scene.positions[t.y], scene.positions[t.z], i));
  }
  if (options.triangle_test == TriangleTest::moeller_trumbore ||
      options.triangle_test == TriangleTest::watertight)
    tree.corner_triangles = corner_triangles(scene);
  tree.test = options.triangle_test;
  tree.positions = scene.positions;
  tree.corners = scene.triangles;
  Builder(scene, options, tree).build();
  widen(tree.bounds);
  return tree;
}

}  // namespace pinocchio
