#include "pinocchio/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/bsp/clear/clear_ways.h"
#include "core/bsp/moving/posed_trees.h"
#include "core/bsp/wide/wide_on_demand.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/coherence.h"
#include "core/trace/rays/ray_sorter.h"
#include "core/trace/settled/settled_triangles.h"
#include "core/trace/walk/kernels.h"
#include "pinocchio/conversion.h"
#include "pinocchio/error.h"

namespace pinocchio {
namespace {

struct IsaEntry {
  Isa isa;
  bool (*is_supported)();
  const Kernels& kernels;
  const MovingKernel& moving;
  const LaneSteps& steps;
  const WideKernel& wide;
};

// The instruction sets of this architecture, narrowest first.
#define PINOCCHIO_ENTRY(name, lanes, feature)                       \
  {.isa = Isa::name,                                                \
   .is_supported = [] { return PINOCCHIO_PROCESSOR_HAS(feature); }, \
   .kernels = name::kKernels,                                       \
   .moving = name::kMovingKernel,                                   \
   .steps = name::kSteps,                                           \
   .wide = name::kWideKernel},
const IsaEntry kIsas[]{PINOCCHIO_ISAS(PINOCCHIO_ENTRY)};
#undef PINOCCHIO_ENTRY

const IsaEntry* find_entry(Isa isa) {
  const auto found =
      std::find_if(std::begin(kIsas), std::end(kIsas), [isa](const IsaEntry& e) { return e.isa == isa; });
  return found == std::end(kIsas) ? nullptr : found;
}

// `isa` is supported.
const IsaEntry& entry_of(Isa isa) {
  const IsaEntry* const entry = find_entry(isa);
  assert(entry);
  return *entry;
}

const Kernel& kernel_of(Isa isa, TriangleTest test) {
  return entry_of(isa).kernels[as_size(test)];
}

Isa checked_isa(std::optional<Isa> wanted) {
  if (!wanted) return default_isa();
  if (!isa_supported(*wanted))
    throw EnvironmentError("--isa " + std::string(isa_name(*wanted)) + ": this processor does not have it");
  return *wanted;
}

// Rays copied to columns at a time, 147 KB of the stack. Rays that diverge are sorted within a block: with
// 256 rays, random ones take 1.25 times as long.
constexpr std::size_t kBlock = 4096;

class Block {
 public:
  // Copies as many of the rays as fit; returns those.
  std::span<const Ray> load(std::span<const Ray> rays) {
    rays = rays.first(std::min(rays.size(), kBlock));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        origin_[axis][i] = rays[i].origin[axis];
        direction_[axis][i] = rays[i].direction[axis];
      }
      t_max_[i] = rays[i].t_max;
    }
    return rays;
  }

  [[nodiscard]] RayColumns columns() const {
    return {{origin_[0], origin_[1], origin_[2]}, {direction_[0], direction_[1], direction_[2]}, t_max_};
  }

 private:
  alignas(kCacheLine) float origin_[3][kBlock];
  alignas(kCacheLine) float direction_[3][kBlock];
  alignas(kCacheLine) float t_max_[kBlock];
};

}  // namespace

const LaneSteps& lane_steps(Isa isa) {
  return entry_of(isa).steps;
}

const MovingKernel& moving_kernel(Isa isa) {
  return entry_of(isa).moving;
}

const WideKernel& wide_kernel(Isa isa) {
  const IsaEntry* entry = &entry_of(isa);
  while (!entry->wide.closest_hits && entry != kIsas) --entry;
  return entry->wide;
}

bool isa_supported(Isa isa) {
  const IsaEntry* const entry = find_entry(isa);
  return entry && entry->is_supported();
}

std::vector<Isa> supported_isas() {
  std::vector<Isa> found;
  for (const IsaEntry& entry : kIsas)
    if (entry.is_supported()) found.push_back(entry.isa);
  return found;
}

Isa default_isa() {
  return supported_isas().back();
}

namespace {

Scene scene_of(std::shared_ptr<const Mesh> mesh) {
  Scene scene;
  scene.mesh = std::move(mesh);
  return scene;
}

}  // namespace

Tracer::Tracer(std::shared_ptr<const Mesh> mesh, const BuildOptions& options, std::optional<Isa> isa,
               OffsetMethod offset)
    : Tracer(scene_of(std::move(mesh)), options, isa, offset, nullptr) {}

Tracer::Tracer(const Scene& scene, const BuildOptions& options, std::optional<Isa> isa, OffsetMethod offset,
               const Tracer* before)
    : build_begin_s_(now_s()), mesh_(scene.mesh), isa_(checked_isa(isa)) {
  PosedTrees posed = build_posed_trees(scene, options, before ? before->trees_.get() : nullptr,
                                       before ? before->motion_.get() : nullptr);
  trees_ = std::move(posed.trees);
  motion_ = std::move(posed.motion);
  offset_ = RayOffset::of(offset, trees_->bounds);
  if (WideOnDemand::serves(*trees_, isa_)) {
    const bool kept =
        before && before->wide_ && before->trees_->still == trees_->still && before->isa_ == isa_;
    wide_ = kept ? before->wide_ : std::make_shared<WideOnDemand>(trees_->still, isa_, options.threads);
  }
  if (isa_ != Isa::scalar && offset == OffsetMethod::error_bound && ClearWaysToLights::serves(*trees_)) {
    clear_ways_ = std::make_shared<ClearWaysToLights>(trees_);
    settled_ = std::make_shared<SettledUnderLights>(mesh_);
  }
  build_end_s_ = now_s();
}

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits, Backfaces backfaces) const {
  assert(rays.size() == hits.size());
  const MaterialMarksOf passed(*mesh_, [&](const Material& m) { return passes_backs(m, backfaces); });
  const MaterialMarks backs = passed.columns();
  Block block;
  alignas(kCacheLine) std::uint32_t triangle[kBlock];
  alignas(kCacheLine) float t[kBlock];
  for (std::size_t first = 0; first < rays.size(); first += kBlock) {
    const std::span<const Ray> part = block.load(rays.subspan(first));
    closest_hits(block.columns(), part.size(), triangle, t, passed.any() ? &backs : nullptr);
    for (std::size_t i = 0; i < part.size(); ++i)
      hits[first + i] = triangle[i] == kNoTriangle ? Hit{} : Hit{t[i], triangle[i]};
  }
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  assert(rays.size() == blocked.size());
  Block block;
  std::uint8_t found[kBlock];
  for (std::size_t first = 0; first < rays.size(); first += kBlock) {
    const std::span<const Ray> part = block.load(rays.subspan(first));
    occluded(block.columns(), part.size(), found);
    std::copy_n(found, part.size(), blocked.begin() + first);
  }
}

namespace {

// Null: the rays are traced in their own order. Allocates once per thread.
RaySorter* sorter_for(Isa isa, const RayColumns& rays, std::size_t n) {
  if (n < kLeastSorted || isa == Isa::scalar || !sorting_pays(rays, n)) return nullptr;
  static thread_local RaySorter sorter;
  return &sorter;
}

// Through the wide tree, then through the trees that move.
void closest_through(const WideTree& wide, const SceneTrees& trees, Isa isa, const RayColumns& rays,
                     std::size_t n, std::uint32_t* triangle, float* t, const MaterialMarks* backs) {
  const bool moving = !trees.top.empty();
  if (moving && !t) {
    static thread_local AlignedVector<float> distances;
    if (distances.size() < n + kQueuePad) distances.resize(n + kQueuePad);
    t = distances.data();
  }
  const WideKernel& still = wide_kernel(isa);
  if (backs)
    still.closest_fronts(trees, wide, rays, n, *backs, triangle, t);
  else
    still.closest_hits(trees, wide, rays, n, triangle, t);
  if (!moving) return;
  if (backs)
    moving_kernel(isa).add_closest_fronts(trees, rays, n, *backs, triangle, t);
  else
    moving_kernel(isa).add_closest_hits(trees, rays, n, triangle, t);
}

}  // namespace

const WideTree* Tracer::wide_tree_for(const RayColumns& rays, std::size_t n) const {
  if (!wide_ || !are_incoherent(rays, n, wide_->center(), wide_->apart())) return nullptr;
  return wide_->tree_after(n, *trees_);
}

void Tracer::closest_hits(const RayColumns& rays, std::size_t n, std::uint32_t* triangle, float* t,
                          const MaterialMarks* backs) const {
  if (const WideTree* const wide = wide_tree_for(rays, n))
    return closest_through(*wide, *trees_, isa_, rays, n, triangle, t, backs);
  const Kernel& kernel = kernel_of(isa_, trees_->still->test);
  const auto trace = [&](const RayColumns& from, std::uint32_t* ids, float* distances) {
    if (backs) return kernel.closest_fronts(*trees_, from, n, *backs, ids, distances);
    kernel.closest_hits(*trees_, from, n, ids, distances);
  };
  RaySorter* const sorter = sorter_for(isa_, rays, n);
  if (!sorter) return trace(rays, triangle, t);
  const RayColumns sorted = sorter->sort(rays, n);
  trace(sorted, sorter->triangles(), t ? sorter->distances() : nullptr);
  sorter->put_back(triangle, t);
}

void Tracer::occluded(const RayColumns& rays, std::size_t n, std::uint8_t* blocked,
                      const PassedSurfaces* passed) const {
  const Kernel& kernel = kernel_of(isa_, trees_->still->test);
  if (passed) return kernel.occluded_unless_passed(*trees_, rays, n, *passed, blocked);
  if (const WideTree* const wide = wide_tree_for(rays, n)) {
    wide_kernel(isa_).occluded(*trees_, *wide, rays, n, blocked);
    if (!trees_->top.empty()) moving_kernel(isa_).add_occluded(*trees_, rays, n, blocked);
    return;
  }
  RaySorter* const sorter = sorter_for(isa_, rays, n);
  if (!sorter) return kernel.occluded(*trees_, rays, n, blocked);
  const RayColumns sorted = sorter->sort(rays, n);
  kernel.occluded(*trees_, sorted, n, sorter->blocked());
  sorter->put_back(blocked);
}

const LaneSteps& Tracer::steps() const {
  return lane_steps(isa_);
}

}  // namespace pinocchio
