#include "core/bsp/build/build.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/large_memory.h"
#include "core/bsp/build/part_queue.h"
#include "core/bsp/build/top.h"
#include "core/parallel/workers.h"
#include "pinocchio/conversion.h"
#include "pinocchio/progress.h"

namespace pinocchio {
namespace {

// Triangles that a thread prepares at a time.
constexpr std::size_t kChunk = 4096;

// Wald and Havran 2006: 8 + 1.3 log2 n holds for triangle meshes of every size.
int default_depth(std::size_t triangles) {
  return as_int(8.0 + 1.3 * std::log2(std::max<std::size_t>(triangles, 1)));
}

int depth_of(const BuildOptions& options, std::size_t triangles) {
  return std::clamp(options.max_depth > 0 ? options.max_depth : default_depth(triangles), 1, kMaxTreeDepth);
}

// Calls body(first, last) for all of [0, n), in pieces.
template <class Body>
void for_each_chunk(Workers& workers, std::size_t n, const Body& body) {
  workers.for_each((n + kChunk - 1) / kChunk,
                   [&](std::size_t i) { body(i * kChunk, std::min(n, (i + 1) * kChunk)); });
}

// Prepares the triangles, in the scene's order, and the references that the tree is built from. A triangle
// without area is left out of the tree: no ray meets it.
References prepare(const BuildMesh& mesh, Workers& workers, BspTree& tree,
                   AlignedVector<ProjectedTriangle>& triangles) {
  const std::size_t n = mesh.size();
  triangles.resize(n);
  References all(n);
  for_each_chunk(workers, n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t id = mesh.id(i);
      const glm::uvec3& t = mesh.triangles[id];
      const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      triangles[i] = ProjectedTriangle::from(a, b, c, id);
      all[i] = BuildReference::of(id, {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!mesh.keeps_flat && std::isnan(triangles[i].n_u)) continue;
    if (kept != i) all[kept] = all[i];
    ++kept;
    tree.bounds.add(all[i].bounds());
  }
  all.shrink(kept);
  return all;
}

// A part and its place in the tree.
struct Placed {
  const Subtree* part;
  std::uint32_t root;  // where its node 0 goes
  std::uint32_t first_node, first_reference;
};

// Assigns every part its place: after the top, each followed by the parts that it handed over. The places do
// not depend on the queue's numbers, which vary from run to run.
class Layout {
 public:
  Layout(const PartQueue& queue, std::size_t top_nodes) : queue_(queue), nodes_(as_uint32(top_nodes)) {
    placed.reserve(queue.size());
  }

  void place(std::size_t number, std::uint32_t root) {
    const Subtree& part = queue_.built(number);
    const std::uint32_t first_node = nodes_;
    placed.push_back({&part, root, first_node, references_});
    nodes_ += as_uint32(part.nodes.size()) - 2;
    references_ += as_uint32(part.references.size());
    for (const Subtree::Handed& handed : part.handed) place(handed.part, handed.index - 2 + first_node);
  }

  [[nodiscard]] std::size_t nodes() const { return nodes_; }
  [[nodiscard]] std::size_t references() const { return references_; }

  std::vector<Placed> placed;

 private:
  const PartQueue& queue_;
  std::uint32_t nodes_, references_ = 0;
};

BspNode moved(const BspNode& n, const Placed& to) {
  return n.is_leaf() ? BspNode::leaf(n.first_reference() + to.first_reference, n.reference_count())
                     : BspNode::inner(n.axis(), n.split(), n.first_child() - 2 + to.first_node);
}

void copy(const Placed& from, BspTree& tree) {
  const Subtree& part = *from.part;
  std::transform(part.nodes.begin() + 2, part.nodes.end(), tree.nodes.begin() + from.first_node,
                 [&](const BspNode& n) { return moved(n, from); });
  std::copy(part.references.begin(), part.references.end(), tree.references.begin() + from.first_reference);
}

void join(const TreeTop& top, const Layout& layout, Workers& workers, BspTree& tree) {
  reserve_large(tree.nodes, layout.nodes());
  reserve_large(tree.references, layout.references());
  tree.nodes.assign(layout.nodes(), BspNode::leaf(0, 0));
  tree.references.resize(layout.references());
  std::copy(top.nodes.begin(), top.nodes.end(), tree.nodes.begin());
  workers.for_each(layout.placed.size(), [&](std::size_t i) { copy(layout.placed[i], tree); });
  // A root's place is in another part, which is copied by now.
  for (const Placed& p : layout.placed) {
    tree.nodes[p.root] = moved(p.part->nodes[0], p);
    tree.depth = std::max(tree.depth, p.part->depth);
  }
}

// The order in which leaves refer to the triangles, as numbers from the mesh's first_id() on. References,
// such numbers until then, become indices in that order.
std::vector<std::uint32_t> order_triangles(const BuildMesh& mesh, BspTree& tree) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  const std::uint32_t first = mesh.first_id();
  std::vector<std::uint32_t> place(mesh.end_id() - first, kNone), order;
  order.reserve(mesh.size());
  for (std::uint32_t& reference : tree.references) {
    std::uint32_t& at = place[reference - first];
    if (at == kNone) {
      at = as_uint32(order.size());
      order.push_back(reference);
    }
    reference = at;
  }
  return order;
}

void build_nodes(const BuildMesh& mesh, const BuildOptions& options, Workers& workers, References all,
                 BspTree& tree) {
  const int max_depth = depth_of(options, mesh.size());
  const CostModel model(options, tree.bounds, options.lights);
  TreeTop top = build_top(mesh, options, model, max_depth, std::move(all), tree.bounds, workers);

  PartQueue queue;
  std::vector<std::uint32_t> roots;
  for (TreePart& part : top.parts) {
    roots.push_back(part.index);
    queue.push(std::move(part));
  }
  workers.for_each(workers.count(), [&](std::size_t) {
    SubtreeBuilder builder(mesh, options, model, max_depth, queue);
    try {
      while (std::optional<PartQueue::Waiting> next = queue.pop())
        queue.deliver(next->number, builder.build(next->part.references.span(), next->part.node));
    } catch (...) {
      queue.abandon();
      throw;
    }
  });
  Layout layout(queue, top.nodes.size());
  for (std::size_t i = 0; i < roots.size(); ++i) layout.place(i, roots[i]);
  join(top, layout, workers, tree);
}

}  // namespace

void widen(Bounds& bounds) {
  if (bounds.empty()) return;
  const glm::vec3 largest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  const float margin = 1e-6f * std::max({largest.x, largest.y, largest.z, 1e-30f});
  bounds.lo -= margin;
  bounds.hi += margin;
}

BspTree build_tree(const BuildMesh& mesh, const BuildOptions& options) {
  begin_phase(options.progress, "build", 1.0);
  BspTree tree;
  Workers workers(options.threads);
  AlignedVector<ProjectedTriangle> prepared;
  build_nodes(mesh, options, workers, prepare(mesh, workers, tree, prepared), tree);
  tree.exact_bounds = tree.bounds;
  widen(tree.bounds);
  const std::vector<std::uint32_t> order = order_triangles(mesh, tree);
  tree.test = options.triangle_test;
  tree.make_room(order.size());
  for_each_chunk(workers, order.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (tree.has_corners())
        tree.corner_triangles[i] = CornerTriangle::from(mesh.positions, mesh.triangles[order[i]], order[i]);
      else
        tree.triangles[i] =
            prepared[mesh.ids ? std::ranges::lower_bound(*mesh.ids, order[i]) - mesh.ids->begin() : order[i]];
  });
  return tree;
}

BspTree build_nodes(const BuildMesh& mesh, const BuildOptions& options, std::vector<std::uint32_t>& order) {
  BspTree tree;
  Workers workers(mesh.size() < kChunk ? 1 : options.threads);
  AlignedVector<ProjectedTriangle> prepared;
  build_nodes(mesh, options, workers, prepare(mesh, workers, tree, prepared), tree);
  tree.exact_bounds = tree.bounds;
  widen(tree.bounds);
  order = order_triangles(mesh, tree);
  return tree;
}

}  // namespace pinocchio
