#include "core/bsp/wide/wide_on_demand.h"

#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

#include "core/bsp/wide/build_wide.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// A triangle takes about 0.5 microseconds to build; a ray saves 0.2 (70,000 triangles) to 1.5 (a million).
constexpr std::size_t kTrianglesPerRay = 1;

}  // namespace

bool WideOnDemand::serves(const SceneTrees& trees) {
  return trees.top.empty() && trees.still->test == TriangleTest::filtered && !trees.still->triangles.empty();
}

WideOnDemand::WideOnDemand(std::shared_ptr<const SceneTrees> trees, int threads)
    : trees_(std::move(trees)), threads_(threads) {
  const std::size_t triangles = trees_->still->triangles.size();
  enough_ = triangles / kTrianglesPerRay;
  if (const char* e = std::getenv("WIDE_ENOUGH")) enough_ = as_size(std::atof(e) * as_double(triangles));
  // Of a surface as large as the box's.
  triangle_size_ = std::sqrt(2.0f * trees_->still->exact_bounds.half_area() / as_float(triangles));
}

const WideTree* WideOnDemand::tree_after(std::size_t rays) {
  if (const WideTree* const tree = built_.load(std::memory_order_acquire)) return tree;
  if (rays_.fetch_add(rays, std::memory_order_relaxed) + rays < enough_) return nullptr;
  if (!begun_.exchange(true)) build();
  return built_.load(std::memory_order_acquire);
}

void WideOnDemand::build() noexcept {
  try {
    tree_ = std::make_unique<const WideTree>(build_wide_tree(*trees_, threads_));
    built_.store(tree_.get(), std::memory_order_release);
  } catch (const std::bad_alloc&) {  // packets need no more memory
  }
}

}  // namespace pinocchio
