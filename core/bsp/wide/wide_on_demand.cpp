#include "core/bsp/wide/wide_on_demand.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/bsp/wide/build_wide.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The number of rays by which the tree would have saved the time of its build, 0.32 microseconds a triangle.
// A ray saves 0.1 microseconds in a small tree, 0.2 in one of 70,000 triangles, 1.5 in one of a million.
std::size_t enough_rays(const BspTree& tree) {
  const float triangles = as_float(tree.triangles.size());
  const float saved = std::max(0.1f, 0.2f * std::pow(triangles / 70000.0f, 0.75f));
  return as_size(0.32f / saved * triangles);
}

// Rays whose neighbours are farther away than this are traced faster by the wide tree than in packets;
// measured on trees of 1,000 to a million triangles (docs/measurements.md). The larger the tree, the less of
// it is in the caches. With 16 lanes: small trees on Zen 4, large ones on a Xeon. With four lanes: measured
// with the first version of the walk, which was as fast.
float distance_apart(const BspTree& tree, Isa isa) {
  const float triangles = as_float(tree.triangles.size());
  const float triangle_size =
      std::sqrt(2.0f * tree.exact_bounds.half_area() / triangles);  // of the box's sides
  const float at_a_million = isa == Isa::avx512 ? 0.4f : isa == Isa::avx2 ? 0.3f : 1.25f;
  const float power = isa == Isa::avx512 ? 0.8f : 0.7f;
  const float sizes = at_a_million * std::pow(1e6f / triangles, power);
  return std::min(sizes * triangle_size, 0.2f * tree.exact_bounds.diagonal());
}

}  // namespace

bool WideOnDemand::serves(const SceneTrees& trees, Isa isa) {
  const std::size_t still = trees.still->triangles.size();
  return isa != Isa::scalar && trees.still->test == TriangleTest::filtered && still > 0 &&
         (trees.top.empty() || 2 * still > trees.corners.size());
}

WideOnDemand::WideOnDemand(std::shared_ptr<const BspTree> still, Isa isa, int threads)
    : threads_(threads),
      center_(still->exact_bounds.center()),
      apart_(distance_apart(*still, isa)),
      enough_(enough_rays(*still)) {}

const WideTree* WideOnDemand::tree_after(std::size_t rays, const SceneTrees& scene) {
  if (const WideTree* const tree = built_.load(std::memory_order_acquire)) return tree;
  if (rays_.fetch_add(rays, std::memory_order_relaxed) + rays < enough_) return nullptr;
  if (!begun_.exchange(true)) build(scene);
  return built_.load(std::memory_order_acquire);
}

void WideOnDemand::build(const SceneTrees& scene) noexcept {
  try {
    tree_ = std::make_unique<const WideTree>(build_wide_tree(scene, threads_));
    built_.store(tree_.get(), std::memory_order_release);
  } catch (const std::bad_alloc&) {  // packets need no more memory
  }
}

}  // namespace pinocchio
