#include "pinocchio/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "core/bsp/build.h"
#include "core/trace/kernels.h"
#include "core/trace/lane_steps.h"
#include "core/trace/ray_sorter.h"
#include "pinocchio/error.h"

namespace pinocchio {
namespace {

struct IsaEntry {
  const Kernels& kernels;
  const LaneSteps& steps;
};

// In Isa's order, narrowest first.
const std::array<IsaEntry, kIsaNames.size()> kIsas{{{scalar::kKernels, scalar::kSteps},
                                                    {sse4::kKernels, sse4::kSteps},
                                                    {avx2::kKernels, avx2::kSteps},
                                                    {avx512::kKernels, avx512::kSteps}}};

const IsaEntry& entry_of(Isa isa) {
  return kIsas[static_cast<std::size_t>(isa)];
}

const Kernel& kernel_of(Isa isa, TriangleTest test) {
  return entry_of(isa).kernels[static_cast<std::size_t>(test)];
}

Isa choose(std::optional<Isa> wanted) {
  if (!wanted) return default_isa();
  if (!isa_supported(*wanted))
    throw EnvironmentError("--isa " + std::string(isa_name(*wanted)) + ": this processor does not have it");
  return *wanted;
}

// Rays that are put in columns at a time.
constexpr std::size_t kBlock = 256;

class Block {
 public:
  // As many of the rays as fit; returns them.
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

bool isa_supported(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return true;
    case Isa::sse4:
      return __builtin_cpu_supports("sse4.1");
    case Isa::avx2:
      return __builtin_cpu_supports("avx2");
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f");
  }
  return false;
}

std::vector<Isa> supported_isas() {
  std::vector<Isa> found;
  for (const Isa isa : {Isa::scalar, Isa::sse4, Isa::avx2, Isa::avx512})
    if (isa_supported(isa)) found.push_back(isa);
  return found;
}

Isa default_isa() {
  return supported_isas().back();
}

Tracer::Tracer(std::shared_ptr<const Mesh> mesh, const BuildOptions& options, std::optional<Isa> isa,
               OffsetMethod offset)
    : mesh_(std::move(mesh)),
      tree_(std::make_shared<const BspTree>(build_tree(*mesh_, options))),
      isa_(choose(isa)),
      offset_(RayOffset::of(offset, tree_->bounds)) {}

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  assert(rays.size() == hits.size());
  Block block;
  alignas(kCacheLine) std::uint32_t triangle[kBlock];
  alignas(kCacheLine) float t[kBlock];
  for (std::size_t first = 0; first < rays.size(); first += kBlock) {
    const std::span<const Ray> part = block.load(rays.subspan(first));
    closest_hits(block.columns(), part.size(), triangle, t);
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
    std::copy_n(found, part.size(), blocked.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

void Tracer::closest_hits(const RayColumns& rays, std::size_t n, std::uint32_t* triangle, float* t) const {
  const auto trace = kernel_of(isa_, tree_->test).closest_hits;
  if (n < kLeastSorted || isa_ == Isa::scalar || !rays_part(rays, n))
    return trace(*tree_, rays, n, triangle, t);
  static thread_local RaySorter sorter;  // its memory is made once a thread
  const RayColumns sorted = sorter.sort(rays, n);
  trace(*tree_, sorted, n, sorter.triangles(), t ? sorter.distances() : nullptr);
  sorter.put_back(triangle, t);
}

void Tracer::occluded(const RayColumns& rays, std::size_t n, std::uint8_t* blocked) const {
  kernel_of(isa_, tree_->test).occluded(*tree_, rays, n, blocked);
}

const LaneSteps& Tracer::steps() const {
  return lane_steps(isa_);
}

}  // namespace pinocchio
