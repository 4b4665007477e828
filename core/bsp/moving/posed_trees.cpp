#include "core/bsp/moving/posed_trees.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

#include "core/base/prefetch.h"
#include "core/bsp/build/build.h"
#include "core/bsp/moving/top_level.h"
#include "core/parallel/workers.h"
#include "core/scene/pose/mesh_pose.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// How often a node moves before it gets a tree of its own: nodes that are put in their place once do not.
constexpr std::uint8_t kMoves = 2;

// Triangles that a thread places at a time.
constexpr std::size_t kPosedChunk = 2048;

// Fewer triangles are placed by one thread.
constexpr std::size_t kForThreads = 8192;

// More threads would wait for memory.
constexpr int kMostThreads = 8;

// Whether both sets of options build the same tree over the same triangles. Lights do not count: they change
// no hit, and move.
bool build_same_trees(const BuildOptions& a, const BuildOptions& b) {
  return a.rule == b.rule && a.max_depth == b.max_depth && a.leaf_size == b.leaf_size &&
         a.cost_step == b.cost_step && a.cost_intersection == b.cost_intersection &&
         a.cost_intersection_light == b.cost_intersection_light &&
         a.cost_intersection_small == b.cost_intersection_small && a.small_side == b.small_side &&
         a.eye == b.eye && a.cost_intersection_eye == b.cost_intersection_eye && a.margin == b.margin &&
         a.triangle_test == b.triangle_test;
}

// Whether both meshes are poses of one, and how the nodes of the second differ.
class Comparison {
 public:
  Comparison(const Mesh& before, const Mesh& now) : before_(before.pose().get()), now_(now.pose().get()) {
    if (before_ && now_)
      related_ = before_->is_of_same_mesh(*now_);
    else if (before_ || now_)
      related_ = (before_ ? before_ : now_)->first.lock().get() == (before_ ? &now : &before);
    else
      related_ = &before == &now;
  }

  [[nodiscard]] bool related(std::size_t nodes) const {
    const auto fits = [nodes](const MeshPose* pose) { return !pose || pose->nodes.size() == nodes; };
    return related_ && fits(before_) && fits(now_);
  }
  [[nodiscard]] bool differs(std::size_t node) const {
    return !place_of(before_, node).same_as(place_of(now_, node));
  }

 private:
  [[nodiscard]] static const NodePlace& place_of(const MeshPose* pose, std::size_t node) {
    static const NodePlace kFirst;
    return pose ? pose->nodes[node] : kFirst;
  }

  const MeshPose *before_, *now_;
  bool related_ = false;
};

class Trees {
 public:
  Trees(const Scene& scene, const BuildOptions& options, const SceneTrees* before, const MotionState* state)
      : scene_(scene), options_(options), mesh_(*scene.mesh) {
    trees_->positions = mesh_.positions;
    trees_->corners = mesh_.triangles;
    if (scene.nodes) {
      motion_ = std::make_shared<MotionState>();
      motion_->mesh = scene.mesh;
      motion_->nodes = scene.nodes;
      motion_->options = options;
      motion_->options.progress = nullptr;
      motion_->copies = SharedCopies(scene, options);
    }
    if (before && state && motion_ && build_same_trees(state->options, options) &&
        state->nodes->nodes.size() == scene.nodes->nodes.size()) {
      const Comparison to(*state->mesh, mesh_);
      if (to.related(scene.nodes->nodes.size())) keep(*before, *state, to);
    }
    if (!trees_->still) build_still();
    place_groups();
    place_copies();
    join();
  }

  [[nodiscard]] PosedTrees finish() { return {std::move(trees_), std::move(motion_)}; }

 private:
  [[nodiscard]] const Node& node(int n) const { return scene_.nodes->nodes[n]; }

  // Takes over from the pose before what is still valid.
  void keep(const SceneTrees& before, const MotionState& state, const Comparison& to) {
    const std::size_t n = scene_.nodes->nodes.size();
    motion_->workers = state.workers;
    differs_.resize(n);
    for (std::size_t i = 0; i < n; ++i) differs_[i] = to.differs(i);
    if (state.nodes->rest == scene_.nodes->rest) motion_->copies.keep(state.copies, differs_);
    count_moves(state);
    gather_groups();
    std::vector<bool> was_still(n, true);
    for (const MovingGroup& group : state.groups)
      for (const int i : group.nodes) was_still[i] = false;
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) {
      if (node(as_int(i)).triangles == 0 || motion_->copies.has_node(i)) continue;
      same = same && was_still[i] == is_still_[i] && !(is_still_[i] && differs_[i]);
    }
    if (same) trees_->still = before.still;
    for (MovingGroup& group : motion_->groups) {
      const auto known = std::ranges::find(state.groups, group.nodes, &MovingGroup::nodes);
      if (known == state.groups.end() || known->root != group.root) continue;
      const bool moved = std::ranges::any_of(group.nodes, [&](int i) { return differs_[i]; });
      if (!moved)
        group = *known;
      else if (group.root >= 0)
        group.kept = known->kept;
    }
  }

  void count_moves(const MotionState& state) {
    const std::size_t n = scene_.nodes->nodes.size();
    const auto count = [n](const std::vector<std::uint8_t>& from) {
      return from.empty() ? std::vector<std::uint8_t>(n, 0) : from;
    };
    motion_->moves = count(state.moves);
    motion_->reshapes = count(state.reshapes);
    const auto add = [](std::uint8_t& to) { to = std::min<std::uint8_t>(to + 1, kMoves); };
    for (std::size_t i = 0; i < n; ++i)
      if (std::memcmp(&scene_.nodes->nodes[i].local, &state.nodes->nodes[i].local, sizeof(glm::mat4)) != 0)
        add(motion_->moves[i]);
    for (const Deformation& d : scene_.nodes->rest->deformations)
      if (differs_[d.node]) add(motion_->reshapes[d.node]);
  }

  // The nodes that get trees of their own. Nodes move with the nearest one above that moves.
  void gather_groups() {
    const std::size_t n = scene_.nodes->nodes.size();
    std::vector<bool> deforms(n, false);
    for (const Deformation& d : scene_.nodes->rest->deformations) deforms[d.node] = true;
    std::vector<int> root(n, -1);
    std::vector<std::vector<int>> of_root(n);
    std::vector<int> reshaped;
    std::size_t still = mesh_.triangles.size(), deforming = 0;
    is_still_.assign(n, true);
    for (std::size_t i = 0; i < n; ++i) {
      const Node& at = scene_.nodes->nodes[i];
      root[i] = motion_->moves[i] >= kMoves ? as_int(i) : at.parent >= 0 ? root[at.parent] : -1;
      if (at.triangles == 0 || motion_->copies.has_node(i) ||
          (deforms[i] ? motion_->reshapes[i] < kMoves : root[i] < 0))
        continue;
      still -= at.triangles;
      is_still_[i] = false;
      if (deforms[i]) {
        deforming += at.triangles;
        reshaped.push_back(as_int(i));
      } else {
        of_root[root[i]].push_back(as_int(i));
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      if (!of_root[i].empty()) motion_->groups.push_back({as_int(i), std::move(of_root[i]), nullptr, {}, {}});
    // Trees of their own would save little, where most of what is built anyhow deforms.
    for (const int i : reshaped) {
      if (deforming > still)
        is_still_[i] = true;
      else
        motion_->groups.push_back({-1, {i}, nullptr, {}, {}});
    }
  }

  void build_still() {
    if (!motion_ || (motion_->groups.empty() && motion_->copies.empty())) {
      trees_->still = std::make_shared<const BspTree>(build_tree(mesh_, options_));
      return;
    }
    std::vector<bool> left_out(mesh_.triangles.size(), false);
    for (const MovingGroup& group : motion_->groups)
      for (const int n : group.nodes)
        std::fill_n(left_out.begin() + node(n).first_triangle, node(n).triangles, true);
    for (std::size_t n = 0; n < scene_.nodes->nodes.size(); ++n)
      if (motion_->copies.has_node(n))
        std::fill_n(left_out.begin() + node(as_int(n)).first_triangle, node(as_int(n)).triangles, true);
    std::vector<std::uint32_t> ids;
    for (std::size_t i = 0; i < left_out.size(); ++i)
      if (!left_out[i]) ids.push_back(as_uint32(i));
    BuildMesh part(mesh_);
    part.ids = ids;
    trees_->still = std::make_shared<const BspTree>(build_tree(part, options_));
  }

  // Triangles that one thread places: of the group that is number `moved` of those that moved.
  struct Chunk {
    std::size_t moved, first, last;
    bool any_flat;  // a triangle has no area
  };

  // Kept from pose to pose: to start threads takes as long as to place thousands of triangles.
  Workers& workers() {
    if (!motion_->workers) {
      const auto cores = as_int(std::max(1u, std::thread::hardware_concurrency()));
      const int wanted = options_.threads > 0 ? options_.threads : cores;
      motion_->workers = std::make_shared<Workers>(std::min(wanted, kMostThreads));
    }
    return *motion_->workers;
  }

  void place_groups() {
    if (!motion_) return;
    const std::vector<glm::mat4> world = world_matrices(scene_.nodes->nodes);
    std::vector<std::size_t> moved;
    std::size_t triangles = 0;
    for (std::size_t g = 0; g < motion_->groups.size(); ++g) {
      if (motion_->groups[g].placed.triangles) continue;
      moved.push_back(g);
      for (const int n : motion_->groups[g].nodes) triangles += node(n).triangles;
    }
    if (moved.empty()) return;
    const auto for_each = [&](std::size_t n, const std::function<void(std::size_t)>& body) {
      if (triangles >= kForThreads && options_.threads != 1) return workers().for_each(n, body);
      for (std::size_t i = 0; i < n; ++i) body(i);
    };
    std::vector<std::optional<Motion>> motions(motion_->groups.size());
    std::vector<std::shared_ptr<StoredTriangles>> stored(motion_->groups.size());
    std::vector<Chunk> whole(moved.size()), parts;
    // Small groups at once: to wake the other threads takes as long as to place a thousand triangles.
    for_each(moved.size(), [&](std::size_t i) {
      MovingGroup& group = motion_->groups[moved[i]];
      const glm::mat4 root = group.root < 0 ? glm::mat4(1.0f) : world[group.root];
      std::optional<Motion>& motion = motions[moved[i]];
      if (group.kept) motion = motion_since(*group.kept, scene_, group.nodes, root);
      if (!motion) {
        group.kept = std::make_shared<const KeptTree>(build_kept(scene_, group.nodes, root, options_));
        motion = Motion{glm::dmat4(1.0), glm::dvec3(0.0)};
      }
      stored[moved[i]] = std::make_shared<StoredTriangles>();
      stored[moved[i]]->test = options_.triangle_test;
      const std::vector<std::uint32_t>& order = group.kept->order;
      stored[moved[i]]->make_room(order.size());
      whole[i] = {i, 0, order.size(), false};
      if (order.size() <= kPosedChunk) place(order, whole[i], *stored[moved[i]]);
    });
    for (const Chunk& chunk : whole)
      if (chunk.last > kPosedChunk)
        for (std::size_t first = 0; first < chunk.last; first += kPosedChunk)
          parts.push_back({chunk.moved, first, std::min(chunk.last, first + kPosedChunk), false});
    for_each(parts.size(), [&](std::size_t i) {
      const std::size_t g = moved[parts[i].moved];
      place(motion_->groups[g].kept->order, parts[i], *stored[g]);
    });
    for (const Chunk& part : parts) whole[part.moved].any_flat |= part.any_flat;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      MovingGroup& group = motion_->groups[moved[i]];
      group.bounds = whole[i].any_flat ? bounds_with_area(group) : bounds_of(group);
      group.placed.tree = group.kept->tree;
      group.placed.triangles = std::move(stored[moved[i]]);
      if (!group.bounds.empty()) motions[moved[i]]->describe(group.bounds, group.placed);
    }
  }

  void place_copies() {
    if (motion_ && !motion_->copies.empty())
      motion_->copies.place(scene_, options_,
                            [&](std::size_t n, const std::function<void(std::size_t)>& body) {
                              if (options_.threads != 1) return workers().for_each(n, body);
                              for (std::size_t i = 0; i < n; ++i) body(i);
                            });
  }

  // Triangles come in the tree's order, from all over the mesh's memory.
  void fetch_ahead(const std::vector<std::uint32_t>& order, std::size_t i) const {
    constexpr std::size_t kCorners = 24, kPositions = 8;  // so many triangles ahead
    const auto ahead = [&](std::size_t by) -> const glm::uvec3& {
      return mesh_.triangles[order[std::min(i + by, order.size() - 1)]];
    };
    prefetch(&ahead(kCorners));
    const glm::uvec3& soon = ahead(kPositions);
    for (int corner = 0; corner < 3; ++corner) prefetch(&mesh_.positions[soon[corner]]);
  }

  // Stores triangles as posed. Those without an area are never hit, as if the tree did not have them.
  void place(const std::vector<std::uint32_t>& order, Chunk& chunk, StoredTriangles& stored) const {
    const bool large = mesh_.triangles.size() > kLargeMesh;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (large) fetch_ahead(order, i);
      const glm::uvec3& corners = mesh_.triangles[order[i]];
      const glm::vec3 &a = mesh_.positions[corners.x], &b = mesh_.positions[corners.y],
                      &c = mesh_.positions[corners.z];
      const ProjectedTriangle triangle = ProjectedTriangle::from(a, b, c, order[i]);
      const bool flat = std::isnan(triangle.n_u);
      chunk.any_flat |= flat;
      if (!stored.has_corners()) {
        stored.triangles[i] = triangle;
        continue;
      }
      stored.corner_triangles[i] = CornerTriangle::from(mesh_.positions, corners, order[i]);
      if (flat) std::fill_n(&stored.corner_triangles[i].corners[0][0], 9, triangle.n_u);
    }
  }

  [[nodiscard]] Bounds bounds_of(const MovingGroup& group) const {
    Bounds bounds;
    for (const int n : group.nodes)
      bounds.add(mesh_.pose() ? mesh_.pose()->nodes[n].bounds : bounds_with_area(group));
    return bounds;
  }

  // The bounds of its triangles that have an area.
  [[nodiscard]] Bounds bounds_with_area(const MovingGroup& group) const {
    Bounds bounds;
    for (const std::uint32_t id : group.kept->order) {
      const glm::uvec3& t = mesh_.triangles[id];
      const glm::vec3 &a = mesh_.positions[t.x], &b = mesh_.positions[t.y], &c = mesh_.positions[t.z];
      if (!has_area(a, b, c)) continue;
      for (const glm::vec3& corner : {a, b, c}) bounds.add(corner);
    }
    return bounds;
  }

  void join() {
    Bounds all = trees_->still->exact_bounds;
    std::vector<Bounds> boxes;
    if (motion_) {
      const auto add = [&](const MovingTree& placed, const Bounds& bounds) {
        if (bounds.empty()) return;
        all.add(bounds);
        trees_->moving.push_back(placed);
        boxes.push_back(bounds);
        widen(boxes.back());
      };
      for (const MovingGroup& group : motion_->groups) add(group.placed, group.bounds);
      for (const SharedCopies::Copy& copy : motion_->copies.copies()) add(copy.placed, copy.bounds);
    }
    trees_->top = build_top_level(boxes);
    widen(all);
    trees_->bounds = all;
  }

  const Scene& scene_;
  const BuildOptions& options_;
  const Mesh& mesh_;
  std::shared_ptr<SceneTrees> trees_ = std::make_shared<SceneTrees>();
  std::shared_ptr<MotionState> motion_;
  std::vector<bool> differs_, is_still_;  // by node; of the pose before
};

}  // namespace

PosedTrees build_posed_trees(const Scene& scene, const BuildOptions& options, const SceneTrees* before,
                             const MotionState* state) {
  return Trees(scene, options, before, state).finish();
}

}  // namespace pinocchio
